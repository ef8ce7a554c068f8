"""Limits on the polar command: rates hold for any time step, stops pass, and each has its name."""

from __future__ import annotations

from math import pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.motion.command.floor_rules import FloorRules
from agv_motion.motion.command.limits import CommandLimits, LimitParameters
from agv_motion.motion.command.polar import STILL, PolarCommand, checked
from agv_motion.planar import wrap

FREE = FloorRules()
COMMANDS = st.builds(
    PolarCommand, st.floats(0.0, 1.0), st.floats(-pi, pi, exclude_max=True), st.floats(-1.0, 1.0)
)
RATE = st.one_of(st.just(0.0), st.floats(0.01, 10.0))
PARAMETERS = st.builds(LimitParameters, RATE, RATE, RATE, RATE, RATE)
STEPS = st.lists(st.tuples(COMMANDS, st.floats(0.0, 3.0)), min_size=1, max_size=20)


def limits(**parameters):
    return CommandLimits.of(LimitParameters(**parameters))


def test_no_limit_changes_nothing_and_none_is_named():
    command = PolarCommand(0.5, 2.0, -0.5)
    assert limits().apply(command, FREE, 0.1) == (command, ())


def test_a_slow_place_is_slow_though_the_motors_may_stick_there():
    limited = limits(minimum=0.4).apply(PolarCommand(0.5, 0.3, 0.0), FloorRules(top_speed=0.3), 0.1)
    assert limited == (PolarCommand(pytest.approx(0.3), 0.3, 0.0), ('slow here',))


def test_what_is_too_weak_is_dropped_whole_and_anew_after_a_stop():
    """Below the minimum from rest, below half of it under way; v and omega by one factor."""
    chain = limits(minimum=0.4)
    assert chain.apply(PolarCommand(0.3, 0.2, -0.1), FREE, 0.1).command == (0.0, 0.2, 0.0)
    assert chain.apply(PolarCommand(0.4, 0.2, -0.1), FREE, 0.1).command == (0.4, 0.2, -0.1)
    raised = chain.apply(PolarCommand(0.2, 0.2, -0.1), FREE, 0.1)
    assert raised == (pytest.approx((0.4, 0.2, -0.2)), ('minimum speed',))
    assert chain.apply(PolarCommand(0.19, 0.2, -0.1), FREE, 0.1).command == (0.0, 0.2, 0.0)
    chain.apply(PolarCommand(0.1, 0.2, 0.5), FREE, 0.1)
    chain.stop()
    assert chain.apply(PolarCommand(0.3, 0.2, 0.0), FREE, 0.1).command == (0.0, 0.2, 0.0)


def test_after_a_stop_v_and_omega_rise_from_zero():
    chain = limits(v_rate=1.0, omega_rate=2.0)
    assert chain.apply(PolarCommand(0.9, 0.0, -0.8), FREE, 1.0).command == (0.9, 0.0, -0.8)
    chain.stop()
    risen = chain.apply(PolarCommand(0.9, 0.0, -0.8), FREE, 0.1).command
    assert risen == pytest.approx((0.1, 0.0, -0.2))


@given(PARAMETERS, STEPS)
def test_no_rate_is_ever_exceeded(given_, steps):
    chain, last = CommandLimits.of(given_), STILL
    for wanted, dt in steps:
        command, _ = chain.apply(wanted, FREE, dt)
        checked(command)
        stopped = wanted.v == 0.0 == wanted.omega
        if given_.v_rate and not stopped:
            assert abs(command.v - last.v) <= given_.v_rate * dt + 1e-9
        if given_.omega_rate and not stopped:
            assert abs(command.omega - last.omega) <= given_.omega_rate * dt + 1e-9
        if given_.theta_rate and last.v > 0.0 and not stopped:
            assert abs(wrap(command.theta - last.theta)) <= given_.theta_rate * dt + 1e-9
        last = command


@given(PARAMETERS, STEPS, COMMANDS.filter(lambda c: c.v > 0.0))
def test_the_wanted_command_is_reached_and_kept(given_, steps, wanted):
    chain = CommandLimits.of(given_)
    for other, dt in steps:
        chain.apply(other, FREE, dt)
    for _ in range(800):
        limited = chain.apply(wanted, FREE, 3.0)
        if limited == (wanted, ()):
            break
    assert limited == (wanted, ())
    assert chain.apply(wanted, FREE, 0.0) == (wanted, ())


@given(PARAMETERS, STEPS, st.floats(0.0, 1.0))
def test_a_stop_passes_at_once(given_, steps, dt):
    chain = CommandLimits.of(given_)
    for wanted, step in steps:
        chain.apply(wanted, FREE, step)
    assert chain.apply(STILL, FREE, dt) == (STILL, ())
    assert chain.apply(PolarCommand(0.0, 1.0, 0.0), FREE, dt) == (STILL, ())


def test_each_limit_is_named():
    chain = limits(v_rate=0.1, theta_rate=0.1, omega_rate=0.1)
    chain.apply(PolarCommand(1.0, 0.0, 1.0), FREE, 1.0)
    limited = chain.apply(PolarCommand(1.0, 1.0, 1.0), FREE, 1.0)
    assert limited.command == pytest.approx((0.2, 0.1, 0.2))
    assert limited.by == ('rate of v', 'rate of omega', 'rate of theta')


def test_the_heading_goes_the_short_way_over_pi():
    chain = limits(theta_rate=0.1)
    chain.apply(PolarCommand(1.0, 3.1, 0.0), FREE, 1.0)
    assert chain.apply(PolarCommand(1.0, -3.1, 0.0), FREE, 1.0).command.theta == -3.1
    chain.apply(PolarCommand(1.0, 3.1, 0.0), FREE, 1.0)
    assert chain.apply(PolarCommand(1.0, -2.0, 0.0), FREE, 1.0).command.theta == pytest.approx(
        wrap(3.2)
    )


def test_from_standstill_the_heading_may_be_any():
    chain = limits(v_rate=0.1, theta_rate=0.1)
    assert chain.apply(PolarCommand(1.0, 2.0, 0.0), FREE, 1.0).command == (0.1, 2.0, 0.0)
    chain.stop()
    assert chain.apply(PolarCommand(1.0, -2.0, 0.0), FREE, 1.0).command.theta == -2.0


def test_the_heading_holds_while_the_trunk_slows_down_to_turn():
    """A command without v has no heading: theta 0 in it must not pull the trunk aside."""
    chain = limits(v_rate=0.25)
    chain.apply(PolarCommand(0.75, 2.0, 0.5), FREE, 3.0)
    seen = [chain.apply(PolarCommand(0.0, 0.0, 0.5), FREE, 1.0).command for _ in range(3)]
    assert seen == [(0.5, 2.0, 0.5), (0.25, 2.0, 0.5), (0.0, 2.0, 0.5)]


def test_on_delicate_floor_turning_ends_at_once_and_begins_again_from_rest():
    chain, wanted = limits(omega_rate=0.1), PolarCommand(0.5, 0.0, 1.0)
    for _ in range(10):
        chain.apply(wanted, FREE, 1.0)
    assert chain.apply(wanted, FloorRules(may_turn=False), 0.1) == (
        PolarCommand(0.5, 0.0, 0.0), ('translation only',),
    )  # fmt: skip
    assert chain.apply(wanted, FREE, 1.0).command.omega == pytest.approx(0.1)


def test_turning_on_the_spot_on_delicate_floor_is_standing():
    limited = limits().apply(PolarCommand(0.0, 0.0, 1.0), FloorRules(may_turn=False), 0.1)
    assert limited.command.v == limited.command.omega == 0.0
    assert limited.by == ('translation only',)


def test_slow_where_the_place_asks_for_it():
    limited = limits().apply(PolarCommand(0.8, 1.0, 0.0), FloorRules(top_speed=0.25), 0.1)
    assert limited == (PolarCommand(0.25, 1.0, 0.0), ('slow here',))


def test_what_would_stick_is_raised_or_dropped_with_hysteresis():
    chain = limits(minimum=0.2)
    seen = [
        chain.apply(PolarCommand(v, 1.0, v / 2), FREE, 0.1).command.v
        for v in (0.1, 0.19, 0.2, 0.5, 0.15, 0.1, 0.09, 0.15)
    ]
    assert seen == pytest.approx([0.0, 0.0, 0.2, 0.5, 0.2, 0.2, 0.0, 0.0])


@given(st.builds(PolarCommand, st.floats(0.1, 0.19), st.just(1.0), st.floats(-0.19, 0.19)))
def test_what_is_raised_keeps_its_centre_of_rotation(wanted):
    chain = limits(minimum=0.2)
    chain.apply(PolarCommand(1.0, 0.0, 0.0), FREE, 0.1)
    raised = chain.apply(wanted, FREE, 0.1).command
    assert max(raised.v, abs(raised.omega)) == pytest.approx(0.2)
    assert raised.omega * wanted.v == pytest.approx(wanted.omega * raised.v)


def test_a_limit_that_is_none_is_refused():
    with pytest.raises(ConfigurationError, match='v_rate = -1'):
        LimitParameters(v_rate=-1.0)
