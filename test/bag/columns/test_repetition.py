"""Rows that are the same bit by bit."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.bag.columns.repetition import repeats

ROW = np.array([1.0, 2.0]).tobytes()


@pytest.mark.parametrize('rows', [1, 2, 8192, 8193, 20000])
def test_one_other_row_is_noticed_wherever_it_is(rows):
    """8192 rows of 16 bytes are compared at once."""
    table = np.tile([1.0, 2.0], (rows, 1))
    assert repeats(table, ROW)
    for where in {0, rows // 2, rows - 1}:
        table[where, 1] = 2.5
        assert not repeats(table, ROW)
        table[where, 1] = 2.0


def test_another_row_is_none():
    assert not repeats(np.tile([1.0, 2.0], (3, 1)), np.array([1.0, -2.0]).tobytes())
    assert repeats(np.empty((5, 0)), b'')
