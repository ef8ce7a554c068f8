"""A trajectory laid over its reference: what was moved, turned and scaled is found again."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.report.stamped_poses import stamped_poses
from agv_motion.report.trajectory_alignment import Alignment, align

NUMBERS = st.floats(-50.0, 50.0)
PLACES = np.array([[0, 0, 0], [1, 0, 0], [1, 2, 0], [-1, 2, 0.5], [0.3, 1, -0.2]])


def poses(places, heading=0.0):
    stamps = np.arange(len(places)) * 10**8
    turn = [0.0, 0.0, np.sin(heading / 2), np.cos(heading / 2)]
    return stamped_poses('/odom', 'odom', stamps, places, np.tile(turn, (len(places), 1)))


@settings(max_examples=30, deadline=None)
@given(NUMBERS, NUMBERS, st.floats(-3.1, 3.1), st.floats(0.2, 5.0))
def test_what_was_done_in_the_plane_is_found_again(x, y, angle, scale):
    """Law: of R (c p) + t each way to align finds R and t, and c where it is asked for."""
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    told = poses(PLACES)
    for how, scaled in (
        (Alignment.ORIGIN, False), (Alignment.SE2, False), (Alignment.SE3, False),
        (Alignment.SE2, True), (Alignment.SE3, True),
    ):  # fmt: skip
        by = scale if scaled else 1.0
        truth = poses(by * PLACES @ turn.T + [x, y, 0], angle)
        laid, moved = align(truth, told, how, scaled=scaled)
        assert moved.rotation == pytest.approx(turn, abs=1e-9)
        assert moved.translation == pytest.approx([x, y, 0], abs=1e-9)
        assert moved.scale == pytest.approx(by)
        assert laid.position == pytest.approx(truth.position, abs=1e-9)
        assert laid.rotation == pytest.approx(truth.rotation, abs=1e-9)


def test_a_mirrored_trajectory_is_turned_and_not_mirrored():
    for how in (Alignment.SE2, Alignment.SE3):
        _, moved = align(poses(PLACES * [1, -1, -1]), poses(PLACES * [1, 1, -1]), how)
        assert np.linalg.det(moved.rotation) == pytest.approx(1.0)


def test_none_changes_nothing():
    told = poses(PLACES)
    laid, moved = align(poses(PLACES + 1), told, Alignment.NONE)
    assert (laid.position == told.position).all()
    assert (moved.rotation == np.eye(3)).all()


@pytest.mark.parametrize('far', [0.0, 1e3, 5e6])
def test_places_that_determine_no_rotation_are_refused(far):
    """Also far from the origin, where rounding looks like a width."""
    line = np.linspace(0.0, 1.7, 30)[:, None] * [1.0, 0.3, 0.0] + far
    with pytest.raises(ConfigurationError, match=r'lie on one line.*se2 or origin'):
        align(poses(line), poses(line), Alignment.SE3)
    align(poses(line), poses(line), Alignment.SE2)
    there = np.full((30, 3), far + 0.1)
    for how in (Alignment.SE2, Alignment.SE3):
        with pytest.raises(ConfigurationError, match=r'are all the same.*origin'):
            align(poses(line), poses(there), how)
    with pytest.raises(ConfigurationError, match='--scale with --align origin'):
        align(poses(line), poses(line), Alignment.ORIGIN, scaled=True)
