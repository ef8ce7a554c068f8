"""Text of others on a terminal: seen, never obeyed, and nothing of it lost."""

from __future__ import annotations

import io
import json
import re
import sys

from hypothesis import given
from hypothesis import strategies as st

from agv_motion.cli.terminal import LineTable, terminal
from agv_motion.cli.visible import VisibleStream, guard, in_line, indented, visible

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


def test_a_stream_is_guarded_once_and_consoles_go_past_it(monkeypatch):
    out = io.TextIOWrapper(io.BytesIO(), encoding='utf-8')
    monkeypatch.setattr(sys, 'stdout', out)
    monkeypatch.setattr(sys, 'stderr', io.StringIO())
    guard()
    guard()
    assert isinstance(sys.stdout, VisibleStream)
    assert sys.stdout.rich_proxied_file is out
    assert sys.stdout.encoding == 'utf-8'
    sys.stdout.writelines(['\x1b[2J', 'x\n'])
    monkeypatch.setenv('FORCE_COLOR', '1')
    terminal().print('a\x1b[5mb [/c]', style='bold', end='', highlight=False)
    sys.stdout.flush()
    assert out.buffer.getvalue().decode() == '\\x1b[2Jx\n\x1b[1ma\\x1b[5mb [/c]\x1b[0m'


def test_what_is_drawn_has_only_colours_of_ours(monkeypatch):
    out = io.StringIO()
    monkeypatch.setattr(sys, 'stdout', out)
    monkeypatch.setenv('FORCE_COLOR', '1')
    table = LineTable('topic', 'n')
    table.add_row('/a\x1b[5m\nFAKE', '1', style='red')
    terminal().print(table)
    lines = out.getvalue().splitlines()
    assert len(lines) == 2
    assert '/a\\x1b[5m\\x0aFAKE' in lines[1]
    assert set(re.findall('\x1b[^m]*m', out.getvalue())) == {'\x1b[0m', '\x1b[1m', '\x1b[31m'}
