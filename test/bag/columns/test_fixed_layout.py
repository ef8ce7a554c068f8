"""Messages that agree in every length are decoded as rows of a matrix."""

from __future__ import annotations

from struct import pack

import numpy as np
import pytest

from agv_motion.bag.cdr.layout import layout
from agv_motion.bag.cdr.message_type import unfold
from agv_motion.bag.columns.fixed_layout import FixedLayout
from agv_motion.bag.columns.text_codes import TextCodes

LAYOUT = layout(unfold('a/msg/A', 'string name\nfloat64 x\nuint16[] v\n', 'ros2msg'))
NAME, X, V = (leaf for leaf in LAYOUT.leaves if leaf.type != 'length')


def message(name, x, *values):
    data = pack('<I', len(name) + 1) + name.encode() + b'\0'
    data += bytes(-len(data) % 8) + pack('<dI', x, len(values))
    return data + pack(f'<{len(values)}H', *values)


def of(first):
    walk = LAYOUT.walk(first, 0, len(first), '<')
    return FixedLayout(walk, LAYOUT.leaves, first, 0, '<')


def rows(fixed, messages, gap=b''):
    data = gap.join(messages) + bytes(8)
    starts = np.cumsum([0, *(len(m) + len(gap) for m in messages[:-1])])
    return fixed.rows(data, starts)


def values(fixed, found, leaf, *, same=False, codes=None):
    texts = {leaf.number: codes or TextCodes()}
    return fixed.values(found, leaf, texts, same=same).tolist()


MESSAGES = [message('odom', 0.5, 1, 2), message('odom', -1.5, 3, 4), message('odom', 9.0, 5, 6)]


@pytest.mark.parametrize('gap', [b'', b'1234567', b'x' * 40])
def test_rows_at_equal_distances_are_read_as_they_lie(gap):
    fixed = of(MESSAGES[0])
    found = rows(fixed, MESSAGES, gap)
    assert found.number == 3
    assert fixed.same(found)
    assert fixed.agree(found).all()
    assert values(fixed, found, X) == [[0.5], [-1.5], [9.0]]
    assert values(fixed, found, V) == [[1, 2], [3, 4], [5, 6]]
    codes = TextCodes()
    assert values(fixed, found, NAME, same=True, codes=codes) == [[0]]
    assert codes.values == ['odom']


def test_rows_at_other_distances_are_gathered():
    fixed = of(MESSAGES[0])
    data = MESSAGES[0] + b'?' + MESSAGES[1] + b'???' + MESSAGES[2] + bytes(8)
    size = len(MESSAGES[0])
    found = fixed.rows(data, np.array([0, size + 1, 2 * size + 4]))
    assert values(fixed, found, X) == [[0.5], [-1.5], [9.0]]


def test_other_texts_of_the_same_length_agree_but_are_not_the_same():
    fixed = of(MESSAGES[0])
    found = rows(fixed, [*MESSAGES, message('base', 1.0, 7, 8)])
    assert not fixed.same(found)
    assert fixed.agree(found).all()
    codes = TextCodes()
    assert values(fixed, found, NAME, codes=codes) == [[0], [0], [0], [1]]
    assert codes.values == ['odom', 'base']


def test_another_length_does_not_agree():
    """One value more, and a name as much shorter, so that both have one size."""
    fixed = of(message('abcdefgh', 1.0, 1))
    other = message('abcdefg', 1.0, 1)
    found = rows(
        fixed, [message('abcdefgh', 1.0, 1), other + bytes(8), message('abcdefgh', 2.0, 2)]
    )
    assert fixed.agree(found).tolist()[:1] == [True]
    assert not fixed.agree(found).all()
    assert not fixed.same(found)
