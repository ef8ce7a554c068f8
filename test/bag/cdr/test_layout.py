"""Where the values of a message lie, by hand (offsets count from behind the header)."""

from __future__ import annotations

from struct import pack

import pytest

from agv_motion.bag.cdr.layout import layout
from agv_motion.bag.cdr.message_type import unfold
from agv_motion.errors import ConfigurationError

POINTS = """float32[2] pair
uint8 flag
Point[] points
string name
=====
MSG: a/Point
uint8 kind
float64 x
"""


def of(definition):
    return layout(unfold('a/msg/A', definition, 'ros2msg'))


def walked(definition, data):
    found = of(definition)
    walk = found.walk(data, 0, len(data), '<')
    return {leaf.path: walk.found[leaf.number] for leaf in found.leaves}, walk


def points(count):
    data = bytearray(pack('<ffB', 1.0, 2.0, 3) + bytes(3) + pack('<I', count))
    for k in range(count):
        data += pack('<B', k) + bytes(-(len(data) + 1) % 8) + pack('<d', k)
    return bytes(data + bytes(-len(data) % 4) + pack('<I', 3) + b'ab\0')


def test_numbers_are_aligned_to_their_size():
    """Two floats at 0, the flag at 8, the length at 12, a point at 16 with its x at 24."""
    found, walk = walked(POINTS, points(1))
    assert found['pair'] == [(0, 2, 4)]
    assert found['flag'] == [(8, 1, 1)]
    assert found['points'] == [(1, 1, 12)]
    assert found['points.kind'] == [(16, 1, 1)]
    assert found['points.x'] == [(24, 1, 8)]
    assert found['name'] == [(36, 3, 1)]
    assert walk.guards == [12, 32]


def test_many_elements_of_one_layout_are_told_as_one_stretch():
    """The first by itself, the others 16 bytes apart."""
    found, _ = walked(POINTS, points(5))
    assert found['points.x'] == [(24, 1, 8), (40, 4, 16)]
    assert found['points.kind'] == [(16, 1, 1), (32, 4, 16)]
    assert walked(POINTS, points(3))[0]['points.x'] == [(24, 1, 8), (40, 2, 16)]
    assert walked(POINTS, points(2))[0]['points.x'] == [(24, 1, 8), (40, 1, 8)]


def test_arrays_in_elements_are_a_stretch_each():
    """Behind the length at 0, elements of 12 bytes: pair, nothing, and a flag with its padding."""
    definition = 'P[] ps\n=====\nMSG: a/P\nfloat32[2] pair\nuint8[0] none\nuint8 flag\n'
    found, _ = walked(definition, pack('<I', 4) + bytes(3 * 12 + 9))
    assert found['ps.pair'] == [(4, 2, 4), (16, 2, 4), (28, 2, 4), (40, 2, 4)]
    assert found['ps.none'] == []
    assert found['ps.flag'] == [(12, 1, 1), (24, 3, 12)]


def test_leaves_say_the_arrays_around_them():
    leaves = {leaf.path: leaf for leaf in of(POINTS).leaves if leaf.type != 'length'}
    assert leaves['pair'].dimensions == (2,)
    assert leaves['points.x'].dimensions == (None,)
    (length,) = leaves['points.x'].lengths
    assert of(POINTS).leaves[length].type == 'length'
    assert leaves['flag'].dimensions == ()


def test_a_sequence_of_numbers_and_an_empty_one():
    found, _ = walked('float64[] v', pack('<I', 2) + bytes(4) + pack('<dd', 1.0, 2.0))
    assert [value for path, value in found.items() if path == 'v'] == [[(8, 2, 8)]]
    lengths, values = of('float64[] v').walk(pack('<I4xd', 1, 0.5), 0, 16, '<').found
    assert (lengths, values) == ([(1, 1, 0)], [(8, 1, 8)])
    _, lengths, _ = of('uint8 a\nuint8[] v').walk(pack('<B3xI', 1, 0), 0, 8, '<').found
    assert lengths == [(0, 1, 4)]
    found, _ = walked('float64[] v', pack('<I', 0))
    assert found['v'] == []


def test_big_endian_lengths_are_read_as_such():
    found = of('uint8[] v')
    walk = found.walk(pack('>I', 3) + b'abc', 0, 7, '>')
    assert walk.found[found.leaves[-1].number] == [(4, 3, 1)]


def test_a_message_that_is_too_short_is_told():
    data = points(3)
    for left, what in (
        (12, 'length at byte 12'), (15, 'length at byte 12'), (16, 'value that ends at byte 64'),
        (63, 'value that ends at byte 64'), (67, 'length at byte 64'),
        (70, 'value that ends at byte 71'),
    ):  # fmt: skip
        with pytest.raises(ValueError, match=f'^its {left} bytes end before a {what}$'):
            of(POINTS).walk(data, 0, left, '<')
    for left in range(len(data)):
        with pytest.raises(ValueError, match='bytes end before a'):
            pytest.fail(f'{left} bytes are read as {of(POINTS).walk(data, 0, left, "<")}')


@pytest.mark.parametrize(('more', 'fits'), [(0, True), (3, True), (4, False)])
def test_padding_at_the_end_is_allowed_more_is_not(more, fits):
    data = points(1) + bytes(more)
    if fits:
        of(POINTS).walk(data, 0, len(data), '<')
        return
    with pytest.raises(ValueError, match='but its type ends after'):
        of(POINTS).walk(data, 0, len(data), '<')


def test_a_string_ends_where_it_says_whatever_follows():
    with pytest.raises(ValueError, match='its 12 bytes end before a value that ends at byte 1004'):
        walked('string a\nstring b', pack('<I', 1000) + bytes(8))


def test_a_length_that_nobody_can_have_ends_at_once():
    with pytest.raises(ValueError, match='bytes end before'):
        walked(POINTS, points(0)[:12] + pack('<I', 2**32 - 1) + bytes(64))


def test_wide_strings_are_refused():
    with pytest.raises(ConfigurationError, match='field name is a wstring'):
        of('wstring name')
