"""Runs that overlap in time are merged; what need not be opened yet stays closed."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.bag.mcap.time_order import Run, in_time_order, inside


def runs(*chunks, opened=None):
    """Return runs of stamps; a message is its stamp, its chunk and its number."""
    opened = [] if opened is None else opened

    def opening(place, stamps):
        def messages(first, last):
            return ((stamps[k], place, k) for k in range(first, last))

        def open_run():
            opened.append(place)
            return Run(stamps, messages) if stamps is not None else None

        return open_run

    found = [(min(s or [0]), i, opening(i, s)) for i, s in enumerate(chunks)]
    return sorted(found, key=lambda run: run[:2])


@settings(max_examples=40)
@given(st.lists(st.lists(st.integers(0, 9), max_size=6).map(sorted), max_size=5))
def test_all_come_by_time_and_equal_ones_as_they_lie(chunks):
    every = sorted((s, i, k) for i, stamps in enumerate(chunks) for k, s in enumerate(stamps))
    assert list(in_time_order(runs(*chunks))) == every


def test_a_chunk_is_opened_when_its_time_comes():
    opened = []
    coming = in_time_order(runs([1, 2], [5, 6], [9], opened=opened))
    assert [next(coming) for _ in range(2)] == [(1, 0, 0), (2, 0, 1)]
    assert opened == [0]
    assert next(coming) == (5, 1, 0)
    assert opened == [0, 1]


def test_a_chunk_that_turns_out_to_be_empty_is_passed_over():
    assert list(in_time_order(runs([1], None, []))) == [(1, 0, 0)]


def test_inside_takes_the_start_and_leaves_the_stop():
    stamps = np.array([0, 4, 5, 6, 2**64 - 1], np.uint64)
    assert inside(stamps, 4, 6).tolist() == [False, True, True, False, False]
    assert inside(stamps, 6, 2**64).tolist() == [False, False, False, True, True]
    assert inside(stamps, 0, 2**70).all()
    assert not inside(stamps, 5, 5).any()
    assert not inside(stamps, 6, 5).any()
