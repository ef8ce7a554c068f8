"""The Ghost seen from the robot: along, across and heading by hand, and where it was on its way."""

from __future__ import annotations

from math import pi
from types import SimpleNamespace as Some

import numpy as np
import pytest

from agv_motion.report.run_errors import LONGEST_GAP, errors_between


def poses(*rows):
    table = np.array(rows, float)
    return Some(time=table[:, 0], pose=table[:, 1:])


def test_errors_are_in_the_frame_of_the_robot_and_between_two_poses_of_the_ghost():
    """At 0.2 s the Ghost is at (1, 2), heading 0.2; the robot at the origin looks to the left."""
    ghost = poses((0.0, 0.0, 2.0, 0.0), (0.4, 2.0, 2.0, 0.4))
    found = errors_between(ghost, poses((0.2, 0.0, 0.0, pi / 2)))
    assert found.time.tolist() == [0.2]
    assert (found.along[0], found.across[0]) == pytest.approx((2.0, -1.0))
    assert found.heading[0] == pytest.approx(0.2 - pi / 2)
    assert found.distance[0] == found.rms() == pytest.approx(5.0**0.5)


def test_headings_are_interpolated_and_compared_over_the_half_turn():
    ghost = poses((0.0, 0.0, 0.0, pi - 0.1), (0.4, 0.0, 0.0, -pi + 0.1))
    found = errors_between(ghost, poses((0.2, 0.0, 0.0, -pi + 0.05)))
    assert found.heading[0] == pytest.approx(-0.05)


def test_only_while_the_ghost_was_on_its_way_and_spoke():
    gap = 1.5 * LONGEST_GAP
    ghost = poses((1.0, 0.0, 0.0, 0.0), (1.2, 0.2, 0.0, 0.0), (1.2 + gap, 1.0, 0.0, 0.0))
    times = (0.9, 1.0, 1.1, 1.2, 1.2 + 0.5 * gap, 1.2 + gap, 1.3 + gap)
    found = errors_between(ghost, poses(*((t, 0.0, 0.0, 0.0) for t in times)))
    assert found.time.tolist() == [1.0, 1.1, 1.2]
