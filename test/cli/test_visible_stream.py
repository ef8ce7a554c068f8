"""What the commands print and draw: the text of others is never obeyed."""

from __future__ import annotations

import io
import re
import sys

from agv_motion.cli.terminal import LineTable, terminal
from agv_motion.cli.visible_stream import VisibleStream, guard


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
