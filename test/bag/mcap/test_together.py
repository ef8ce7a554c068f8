"""Messages as columns: where they would end, and the first one from a time on."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.bag.mcap.records import MESSAGE_HEAD
from agv_motion.bag.mcap.together import FEW, Together


def test_ends_count_heads_and_messages():
    together = Together([1, 2], [5, 6], [b'abc', b'de'])
    head = MESSAGE_HEAD.size
    assert together.ends.tolist() == [head + 3, 2 * head + 5]
    assert together.channels.tolist() == [1, 2]


@settings(max_examples=40)
@given(st.lists(st.integers(0, 20), min_size=1, max_size=30), st.integers(0, 21), st.data())
def test_the_first_from_a_time_on(stamps, time, data):
    together = Together([1] * len(stamps), stamps, [b''] * len(stamps))
    first = data.draw(st.integers(0, len(stamps)))
    last = data.draw(st.integers(first, len(stamps)))
    wanted = next((k for k in range(first, last) if stamps[k] >= time), last)
    assert together.first_from(first, last, time) == wanted


@pytest.mark.parametrize('where', [0, FEW - 1, FEW, 3 * FEW - 1, 3 * FEW, 4 * FEW])
def test_it_is_found_beyond_the_first_piece(where):
    stamps = np.zeros(5 * FEW, int)
    stamps[where] = 9
    together = Together(stamps * 0, stamps, [b''] * len(stamps))
    assert together.first_from(0, len(stamps), 9) == where
    assert together.first_from(where + 1, len(stamps), 9) == len(stamps)
    assert together.first_from(0, len(stamps), 2**64) == len(stamps)
