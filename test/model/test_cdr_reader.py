"""Fields of a message in the order in which they stand, of either order of bytes, or an error."""

from __future__ import annotations

from contextlib import suppress
from struct import pack

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.model.cdr_reader import CdrReader


def test_the_order_of_bytes_is_that_of_the_message():
    for order, mark in (('<', b'\0\1\0\0'), ('>', b'\0\0\0\0')):
        data = mark + pack(f'{order}iI', 7, 500) + pack(f'{order}I', 2) + b'a\0'
        data += bytes(-len(data) % 4) + pack(f'{order}I', 3)
        reader = CdrReader(data)
        assert (reader.time(), reader.text()) == (7_000_000_500, 'a')
        assert (reader.count(), reader.at, reader.order) == (3, len(data), order)


@given(st.binary(max_size=80))
def test_no_bytes_do_more_than_end_in_an_error(data):
    for read in ('time', 'text', 'texts', 'count'):
        with suppress(SignalError):
            getattr(CdrReader(data), read)()


def test_a_length_that_cannot_be_costs_no_memory():
    for read in ('text', 'texts'):
        with pytest.raises(SignalError, match='ends in the midst'):
            getattr(CdrReader(b'\0\1\0\0\xff\xff\xff\xff'), read)()
    with pytest.raises(SignalError, match='UTF-8'):
        CdrReader(b'\0\1\0\0\2\0\0\0\xff\0').text()
