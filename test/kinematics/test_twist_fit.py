"""What is asked of measured columns."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.errors import SignalError
from agv_motion.kinematics.twist_fit import require_columns


def test_rows_become_an_array():
    assert require_columns('speeds', [(1, 2, 3), (4, 5, 6)], 2).tolist() == [[1, 2, 3], [4, 5, 6]]


@pytest.mark.parametrize(('bad', 'row'), [(np.nan, 0), (np.inf, 2), (-np.inf, 3)])
def test_the_first_row_that_is_not_finite_is_named(bad, row):
    columns = np.zeros((2, 4))
    columns[1, row:] = bad
    with pytest.raises(SignalError, match=f'speeds columns are not finite at row {row}: drop'):
        require_columns('speeds', columns, 2)


@pytest.mark.parametrize('columns', [np.zeros(2), np.zeros((3, 4)), np.zeros((2, 4, 1))])
def test_another_shape_is_refused(columns):
    with pytest.raises(SignalError, match=r'speeds columns have shape .*, expected \(2, n\)'):
        require_columns('speeds', columns, 2)
