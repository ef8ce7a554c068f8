"""Rows that are left out: the first is the error, all are counted, few are told."""

from __future__ import annotations

from pathlib import Path

from agv_motion.probe.tables.left_out import MOST_TOLD, LeftOut


def test_nothing_left_out_is_nothing_told_and_no_row_at_all_is_an_error():
    rows = LeftOut(Path('x.csv'))
    assert rows.told() == ''
    assert 'x.csv has no row with a time' in str(rows.error())


def test_the_first_row_is_the_error_and_words_of_the_file_stay_out_of_what_is_told():
    rows = LeftOut(Path('x.csv'))
    rows.add(9, 2, "'secret' is no number", 'no number')
    rows.add(4, 1, 'no time')
    assert 'line 4' in str(rows.error())
    assert 'no time' in str(rows.error())
    assert rows.told() == 'rows of x.csv left out: 2 (line 4: no time; line 9: no number)'


def test_many_are_counted():
    rows = LeftOut(Path('x.csv'))
    for line in range(MOST_TOLD):
        rows.add(line, 1, 'no time')
    assert 'more' not in rows.told()
    rows.add(MOST_TOLD, 1, 'no time')
    assert rows.told().endswith('line 2: no time; and 1 more)')
