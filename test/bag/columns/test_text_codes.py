"""Numbers for texts."""

from __future__ import annotations

import pytest

from agv_motion.bag.columns import text_codes
from agv_motion.bag.columns.text_codes import TextCodes


def test_the_same_text_has_the_same_number():
    codes = TextCodes()
    words = [b'odom', b'base', b'odom', b'', 'Übung'.encode()]
    assert [codes.code(word) for word in words] == [0, 1, 0, 2, 3]
    assert codes.values == ['odom', 'base', '', 'Übung']


def test_beyond_a_limit_each_is_kept_so_that_the_table_stays_small(monkeypatch):
    monkeypatch.setattr(text_codes, '_MOST', 2)
    codes = TextCodes()
    assert [codes.code(word) for word in (b'a', b'b', b'c', b'c', b'a')] == [0, 1, 2, 3, 0]
    assert codes.values == ['a', 'b', 'c', 'c']


def test_what_is_no_text_is_refused():
    with pytest.raises(ValueError, match='utf-8'):
        TextCodes().code(b'\xff')
