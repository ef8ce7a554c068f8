"""Where a robot was carried during a drive: what is left belongs together."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from agv_motion.odometry.calibration_cuts import WINDOW, _windows, groups


@pytest.mark.parametrize(
    ('linked', 'found'),
    [
        ('111111', [[10, 11, 12, 20, 21, 22, 23]]),
        ('110111', [[10, 11, 12], [20, 21, 22, 23]]),
        ('101111', [[12, 20, 21, 22, 23]]),  # two tell nothing
        ('000000', []),
        ('011011', [[11, 12, 20], [21, 22, 23]]),
    ],
)
def test_references_are_parted_where_two_neighbours_are_not_linked(linked, found):
    kept = np.array([10, 11, 12, 20, 21, 22, 23])
    parts = groups(kept, np.array([mark == '1' for mark in linked]))
    assert [part.tolist() for part in parts] == found


def test_one_reference_alone_is_no_group():
    assert groups(np.array([4]), np.zeros(0, bool)) == []


def test_what_a_place_may_be_off_grows_with_the_way_and_the_turn():
    """2 m along and 1 rad round a window of nine; 0.02 of 2 m, twice for a whole radian."""
    count = WINDOW + 1
    steps = np.arange(count) * 2
    moved = np.zeros((3, 2 * count))
    moved[0], moved[2] = 2.0 / (2 * (WINDOW - 1)), 1.0 / (2 * (WINDOW - 1))
    drive = SimpleNamespace(
        turned=moved, steering=None, reference_step=steps, reference=np.zeros((3, count)),
        position_noise=0.1, heading_noise=0.03,
    )  # fmt: skip
    model = SimpleNamespace(displacement=lambda *_: moved)
    found = _windows(model, drive, np.zeros(1), 0.02)
    assert found.far == pytest.approx(np.full((2, 1), 5.0 * 0.1 + 0.02 * 2.0 * 2.0))
    assert found.turned == pytest.approx(np.full((2, 1), 5.0 * 0.03 + 0.02 * 2.0))
    assert found.wheels.shape == found.places.shape == found.turns.shape == (2, WINDOW)
