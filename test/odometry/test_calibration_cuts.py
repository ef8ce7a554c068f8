"""Where a robot was carried during a drive: what is left belongs together."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.odometry.calibration_cuts import groups


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
