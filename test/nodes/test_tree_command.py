"""The command of a tree: by its limits, in even steps, and a zero at once."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from agv_motion.motion.command.floor_rules import FloorRules
from agv_motion.motion.command.limits import LimitParameters
from agv_motion.motion.command.polar import PolarCommand
from agv_motion.nodes.motion_parameters import MotionGeneratorParameters
from agv_motion.nodes.tree_command import TreeCommand
from agv_motion.planar import REST

FORWARD = SimpleNamespace(wanted=PolarCommand(1.0, 0.0, 0.0), rules=FloorRules())


@pytest.fixture
def command():
    limits = LimitParameters(v_rate=0.1)
    given = MotionGeneratorParameters(limits=limits, linear_speed=0.5, rate=10.0)
    port = SimpleNamespace(now=100.0, sent=[])
    port.seconds = lambda: port.now
    publisher = SimpleNamespace(publish=lambda twist, _: port.sent.append(twist))
    port.row_publisher = lambda *_, **__: publisher
    port.nanoseconds = lambda: round(port.now * 1e9)
    command = TreeCommand(port, given)
    command.at = lambda now: (setattr(port, 'now', now), command.move(FORWARD, now))
    command.sent = port.sent
    return command


def test_speed_rises_by_its_rate_and_a_hiccup_counts_no_more_than_two_steps(command):
    for now in (100.1, 100.2, 170.0):
        command.at(now)
    assert [twist.vx / 0.5 for twist in command.sent] == pytest.approx([0.01, 0.02, 0.04])
    assert command.twist == command.sent[-1]
    assert 'rate of v' in command.limited_by


def test_a_clock_that_goes_back_adds_nothing(command):
    command.at(100.1)
    command.at(50.0)
    assert command.sent[-1].vx / 0.5 == pytest.approx(0.01)


def test_the_first_command_after_a_rest_counts_from_its_beginning(command):
    command.begin(500.0)
    command.at(500.1)
    assert command.sent[-1].vx / 0.5 == pytest.approx(0.01)


def test_a_stop_is_a_zero_at_once_and_the_next_motion_begins_there(command):
    for step in range(1, 9):
        command.at(100.0 + 0.1 * step)
    command.stop()
    assert (command.twist, command.limited_by) == (REST, ())
    command.at(100.9)
    assert command.sent[-1].vx / 0.5 == pytest.approx(0.01)
