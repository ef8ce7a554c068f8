"""Texts and ragged rows, which are used like arrays and lists."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.bag.columns.column import Ragged, Texts

WORDS = Texts(np.array([[0, 1], [2, 0]], np.uint32), ['left', 'right', 'left'])
ROWS = Ragged(np.array([1.0, 2.0, 3.0, 4.0]), np.array([0, 1, 1, 4]))


def test_texts_are_an_array_of_strings():
    assert WORDS.shape == (2, 2)
    assert len(WORDS) == 2
    assert WORDS[0, 1] == 'right'
    assert WORDS.tolist() == [['left', 'right'], ['left', 'left']]
    assert [row.tolist() for row in WORDS] == WORDS.tolist()
    assert WORDS[:, 0].tolist() == ['left', 'left']
    assert repr(WORDS) == "Texts('left', 'right', 'left', ...; shape (2, 2))"
    assert repr(WORDS[0]) == "Texts('left', 'right'; shape (2,))"
    assert WORDS.nbytes == 16 + 4 + 5 + 4


def test_texts_are_compared_by_what_they_say_not_by_their_numbers():
    """Two numbers stand for the same text here."""
    assert (WORDS == 'left').tolist() == [[True, False], [True, True]]
    assert (WORDS != 'left').tolist() == [[False, True], [False, False]]
    assert (WORDS == 'up').tolist() == [[False] * 2] * 2
    other = Texts(np.array([[1, 0], [0, 0]], np.uint32), ['right', 'left'])
    assert (other == WORDS).tolist() == [[True, True], [False, False]]
    assert (WORDS[:] == WORDS).all()
    assert WORDS != 7
    with pytest.raises(TypeError, match='unhashable'):
        hash(WORDS)


def test_ragged_rows_are_a_list_of_arrays():
    assert len(ROWS) == 3
    assert ROWS.tolist() == [[1.0], [], [2.0, 3.0, 4.0]]
    assert ROWS.lengths.tolist() == [1, 0, 3]
    assert ROWS[-1].tolist() == [2.0, 3.0, 4.0]
    assert ROWS[1:].tolist() == [[], [2.0, 3.0, 4.0]]
    assert ROWS[:-1].tolist() == [[1.0], []]
    assert ROWS[3:1].tolist() == []
    assert repr(ROWS) == 'Ragged(3 rows of 0 to 3 values)'
    assert repr(ROWS[3:]) == 'Ragged(0 rows of 0 values)'
    assert ROWS.nbytes == 8 * 8


@pytest.mark.parametrize('row', [3, -4])
def test_a_row_that_is_not_there_is_an_index_error(row):
    with pytest.raises(IndexError, match='out of range'):
        ROWS[row]
