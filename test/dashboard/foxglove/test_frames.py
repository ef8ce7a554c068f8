"""Frames are what an independent parser of RFC 6455 reads, whatever the length."""

from __future__ import annotations

import pytest

pytest.importorskip('websockets')

from hypothesis import given, settings
from hypothesis import strategies as st
from websockets.client import ClientProtocol
from websockets.frames import Opcode
from websockets.protocol import OPEN
from websockets.uri import parse_uri

from agv_motion.dashboard.foxglove.frames import frame, message_header

SIZES = st.sampled_from([0, 1, 112, 113, 125, 126, 1000, 65522, 65523, 65536, 70000])


def received(data):
    """Return the frames in some bytes, as the library websockets reads them."""
    protocol = ClientProtocol(parse_uri('ws://127.0.0.1/'), state=OPEN, max_size=None)
    protocol.receive_data(data)
    assert protocol.parser_exc is None
    return [(one.opcode, bytes(one.data), one.fin) for one in protocol.events_received()]


@settings(max_examples=40)
@given(st.lists(SIZES, max_size=5), st.integers(0, 2**32 - 1), st.integers(0, 2**64 - 1))
def test_messages_in_one_piece_are_read_one_by_one(sizes, subscription, stamp):
    data = [bytes([n % 251]) * size for n, size in enumerate(sizes)]
    parts = b''.join(message_header(subscription, stamp, len(one)) + one for one in data)
    head = b'\1' + subscription.to_bytes(4, 'little') + stamp.to_bytes(8, 'little')
    expected = [(Opcode.BINARY, head + one, True) for one in data]
    assert received(parts) == expected


@settings(max_examples=40)
@given(SIZES)
def test_texts_and_bytes_are_told_apart(size):
    assert received(frame('x' * size)) == [(Opcode.TEXT, b'x' * size, True)]
    assert received(frame(b'x' * size)) == [(Opcode.BINARY, b'x' * size, True)]
