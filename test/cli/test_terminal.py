"""Tables of a terminal: no name and no number in them is broken or cut off."""

from __future__ import annotations

from io import StringIO

import pytest

from agv_motion.cli.terminal import LineTable, terminal

NAME = '/oak/wheel_kinematics/transition_event'
ROWS = (NAME, '18434', '50.037'), ('/x', '1', '0.100')


def drawn(width, *titles):
    """Return the lines of a table in a terminal of so many columns."""
    console = terminal()
    console.file, console.width = StringIO(), width
    table = LineTable()
    for title in titles:
        table.add_column(title, justify='left' if title == 'topic' else 'right', overflow='fold')
    for row in ROWS:
        table.add_row(*row)
    console.print(table)
    return console.file.getvalue().splitlines()


@pytest.mark.parametrize('width', [20, 40, 80, 200])
def test_names_and_numbers_are_whole_in_a_terminal_of_any_width(width):
    lines = drawn(width, 'topic', 'messages', 'Hz')
    assert [tuple(line.split()) for line in lines[-2:]] == list(ROWS)
    assert max(map(len, lines)) <= max(width, 60)


def test_what_is_text_is_broken_where_the_terminal_ends():
    console = terminal()
    console.file, console.width = StringIO(), 60
    table = LineTable('name', 'meaning')
    table.add_row(NAME, 'what becomes of the node, whoever asked for it, and when it did')
    console.print(table)
    lines = console.file.getvalue().splitlines()
    assert len(lines) > 2
    assert lines[1].startswith(f'{NAME} ')
    assert max(map(len, lines)) <= 60
