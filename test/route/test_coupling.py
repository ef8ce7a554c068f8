"""Coupling: the three forms by hand, and that a time means the same at every rate."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.route.coupling import Coupling, CouplingForm


def outputs(form, targets, dt=0.1, ramp=0.4, output=0.0):
    coupling = Coupling(ramp, form, output)
    return [coupling.follow(target, dt) for target in targets]


def test_corrected_closes_the_gap_in_a_straight_line():
    assert outputs(CouplingForm.CORRECTED, [1.0] * 5) == pytest.approx([0.25, 0.5, 0.75, 1.0, 1.0])


def test_per_tick_is_its_equation_once_a_tick():
    """0.25; 0.25 + 0.5 * 0.75 = 0.625; 0.625 + 0.75 * 0.375 = 0.90625; 1."""
    assert outputs(CouplingForm.PER_TICK, [1.0] * 4) == pytest.approx([0.25, 0.625, 0.90625, 1.0])


def test_seed_takes_the_last_target_for_the_last_output():
    """0 + 0.25 * 1; then a constant target is reached at once; 1 + 0.75 * (3 - 1) = 2.5."""
    assert outputs(CouplingForm.ORIGINAL, [1.0, 1.0, 3.0, 3.0]) == pytest.approx(
        [0.25, 1.0, 2.5, 3.0]
    )


@pytest.mark.parametrize('form', CouplingForm)
def test_without_a_time_there_is_no_coupling(form):
    assert outputs(form, [1.0, 0.2, -3.0], ramp=0.0) == [1.0, 0.2, -3.0]


@pytest.mark.parametrize('form', CouplingForm)
def test_many_small_steps_make_a_whole_one(form):
    """Ten of 0.1 s are a digit short of a second."""
    coupling = Coupling(1.0, form)
    for _ in range(9):
        coupling.follow(0.3, 0.1)
        assert coupling.share < 1.0
    assert coupling.follow(0.7, 0.1) == 0.7
    assert coupling.share == 1.0


@pytest.mark.parametrize('form', CouplingForm)
def test_once_joined_it_follows_exactly_until_it_is_reset(form):
    coupling = Coupling(0.4, form)
    for _ in range(4):
        coupling.follow(1.0, 0.1)
    assert coupling.follow(0.3, 0.1) == 0.3
    coupling.reset()
    assert coupling.follow(0.7, 0.0) == 0.3


def test_it_goes_on_from_the_speed_it_is_given():
    assert outputs(CouplingForm.CORRECTED, [1.0, 1.0], output=0.6) == pytest.approx([0.7, 0.8])


def test_after_a_rest_it_starts_from_zero():
    coupling = Coupling(0.4)
    coupling.follow(1.0, 0.4)
    coupling.rest()
    assert coupling.follow(1.0, 0.1) == pytest.approx(0.25)


@given(st.lists(st.floats(0.001, 0.2), min_size=1, max_size=30), st.floats(-2.0, 2.0))
def test_after_a_time_the_gap_is_the_same_whatever_the_ticks(steps, target):
    """The law (2): 1 - c of the gap is left, at 10 Hz, at 100 Hz and at no steady rate."""
    coupling = Coupling(1.0, output=0.5)
    for dt in steps:
        coupling.follow(target, dt)
    left = max(1.0 - sum(steps), 0.0)
    assert coupling.output == pytest.approx(target + left * (0.5 - target), abs=1e-6)


@given(st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=30), st.sampled_from(CouplingForm))
def test_it_never_leaves_the_range_of_its_targets(targets, form):
    coupling = Coupling(0.5, form)
    for target in targets:
        output = coupling.follow(target, 0.05)
        assert min(0.0, *targets) - 1e-12 <= output <= max(0.0, *targets) + 1e-12
