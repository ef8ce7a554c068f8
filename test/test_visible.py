"""Text of others on a terminal: seen, never obeyed, and nothing of it lost."""

from __future__ import annotations

import json
import re

from hypothesis import given
from hypothesis import strategies as st

from agv_motion.visible import in_line, indented, visible

OBEYED = {*range(9), 11, 12, *range(14, 32), *range(127, 160), 0x61C, 0x200E, 0x200F}
OBEYED |= {*range(0x2028, 0x202F), *range(0x2066, 0x206A)}
texts = st.text(
    st.characters(exclude_categories=['Cs'], exclude_characters='\\')
    | st.sampled_from([*map(chr, OBEYED), '\r', '\n'])
)


@given(texts)
def test_nothing_is_left_to_obey_and_nothing_is_lost(text):
    shown = visible(text)
    assert not OBEYED & set(map(ord, shown))
    assert '\r' not in shown.replace('\r\n', '')
    assert visible(shown) == shown
    assert re.sub(r'\\[xu]([0-9a-f]{4}|[0-9a-f]{2})', lambda c: chr(int(c[1], 16)), shown) == text


@given(texts)
def test_json_is_still_the_same_json(text):
    assert json.loads(visible(json.dumps(text, ensure_ascii=False))) == text


def test_forms():
    assert visible('a\x1b[2Jb\x9bc\u202ed\te\nf\r\ng\r') == (
        'a\\x1b[2Jb\\u009bc\\u202ed\te\nf\r\ng\\x0d'
    )
    assert in_line('a\nb\tc\r\n') == 'a\\x0ab\\x09c\\x0d\\x0a'
    assert indented('a\nb') == 'a\n    b'
