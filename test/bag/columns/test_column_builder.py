"""Columns that grow: the same rows once, tables, then ragged, whatever the batches."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.bag.columns.column_builder import ColumnBuilder, ColumnMemory, Growing, Part


def builder(rows=4, limit=1 << 20, dtype='<f8'):
    return ColumnBuilder(ColumnMemory(), dtype, rows, limit)


def table(*rows, first=0):
    values = np.array(rows, float)
    return Part(slice(first, first + len(rows)), values.shape[1], values)


def listed(column):
    """Return a finished column as a list of rows."""
    values, counts = column.finish()
    if isinstance(counts, int):
        assert values.shape[1] == counts
        return values.tolist()
    ends = np.cumsum(counts)
    return [values[end - n : end].tolist() for end, n in zip(ends, counts, strict=True)]


def test_a_row_that_all_repeat_is_kept_once():
    column = builder()
    column.put(2, [table([1.0, 2.0], [1.0, 2.0])])
    column.put(1, [table([1.0, 2.0])])
    values, counts = column.finish()
    assert (values.shape, counts, values.strides[0]) == ((3, 2), 2, 0)
    assert values.tolist() == [[1.0, 2.0]] * 3


def test_where_memory_is_refused_there_is_none_and_no_error():
    assert len(ColumnMemory().take(np.dtype('u1'), 1 << 60)) == 0


def test_another_row_ends_the_repetition_with_nothing_lost():
    column = builder()
    column.put(2, [table([1.0], [1.0])])
    column.put(2, [table([1.0], [5.0])])
    assert listed(column) == [[1.0], [1.0], [1.0], [5.0]]


def test_nought_and_minus_nought_are_not_the_same_row():
    column = builder()
    column.put(2, [table([0.0], [-0.0])])
    values, _ = column.finish()
    assert np.signbit(values).ravel().tolist() == [False, True]


def test_another_number_of_values_makes_it_ragged():
    column = builder()
    column.put(1, [table([1.0, 2.0])])
    column.put(1, [table([3.0])])
    column.put(1, [table([])])
    assert listed(column) == [[1.0, 2.0], [3.0], []]


def test_parts_of_a_batch_go_to_their_rows():
    """Rows 0 and 2 have one layout, row 1 another."""
    column = builder()
    even = Part(np.array([0, 2]), 1, np.array([[1.0], [3.0]]))
    odd = Part(np.array([1]), np.array([2]), np.array([7.0, 8.0]))
    column.put(3, [even, odd])
    assert listed(column) == [[1.0], [7.0, 8.0], [3.0]]


def test_a_column_without_rows_is_empty():
    values, counts = builder().finish()
    assert (values.shape, counts) == ((0, 0), 0)


@settings(max_examples=40)
@given(
    st.lists(st.lists(st.lists(st.integers(0, 2), max_size=3), min_size=1, max_size=4), max_size=6),
    st.integers(0, 5),
)
def test_what_is_put_is_what_is_there(batches, expected):
    column = builder(rows=expected, limit=64)
    for rows in batches:
        counts = np.array([len(row) for row in rows])
        values = np.array([value for row in rows for value in row], float)
        column.put(len(rows), [Part(slice(0, len(rows)), counts, values)])
    assert listed(column) == [row for rows in batches for row in rows]


def test_memory_is_handed_out_once():
    """Pieces of 100 kB come out of common blocks and must not overlap."""
    memory = ColumnMemory()
    arrays = [memory.take(np.dtype('<f8'), 12500) for _ in range(5)]
    for number, array in enumerate(arrays):
        assert len(array) == 12500
        array[:] = number
    assert [set(array.tolist()) for array in arrays] == [{0.0}, {1.0}, {2.0}, {3.0}, {4.0}]
    assert not arrays[0].flags.owndata
    assert memory.take(np.dtype('u1'), 10).flags.owndata


def test_memory_is_taken_for_what_is_expected_and_no_more_than_can_be():
    """Of 100 bytes 12 floats have room; of rows of changing length nothing is known."""
    asked = []

    class Memory(ColumnMemory):
        def take(self, dtype, count):
            asked.append((dtype.str, count))
            return super().take(dtype, count)

    ragged = Part(slice(0, 2), np.array([1, 2]), np.array([1.0, 2.0, 3.0]))
    for rows, parts in (
        (4, [table([1.0, 2.0], [3.0, 4.0])]), (100, [table([1.0, 2.0], [3.0, 4.0])]),
        (7, [ragged]),
    ):  # fmt: skip
        ColumnBuilder(Memory(), '<f8', rows, 100).put(2, parts)
    assert asked == [('<f8', 8), ('<f8', 12), ('<f8', 0), ('<i8', 7)]
    column = ColumnBuilder(Memory(), '<f8', 1, 100)
    column.put(2, [table([1.0], [3.0])])
    column.put(2, [ragged])
    assert asked[4:] == [('<f8', 1), ('<i8', 4)]


def test_parts_that_tell_the_same_number_in_two_ways_are_a_table():
    column = builder()
    even = Part(np.array([0, 2]), 1, np.array([[1.0], [3.0]]))
    column.put(3, [even, Part(np.array([1]), np.array([1]), np.array([2.0]))])
    values, counts = column.finish()
    assert (values.tolist(), counts) == ([[1.0], [2.0], [3.0]], 1)


def test_an_array_grows_by_a_fifth_or_by_what_is_needed():
    growing = Growing(np.empty(10))
    growing.more(10)
    for more, size in ((1, 12), (1, 12), (1, 14), (10, 23)):
        growing.more(more)
        assert len(growing._array) == size  # noqa: SLF001 - how far ahead it takes memory
    assert len(growing.finish()) == 23


def test_an_array_grows_whoever_owns_its_memory():
    for begin in (np.empty(2), np.empty(8)[:2]):
        growing = Growing(begin)
        for k in range(50):
            growing.more(3)[:] = k
        assert growing.finish().tolist() == [k for k in range(50) for _ in range(3)]
