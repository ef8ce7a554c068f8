"""The form of a table: what stands between its columns, and where each wanted one is."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.probe.tables.file_text import FileLine
from agv_motion.probe.tables.table_form import HEAD, TableForm, find_form, is_number, split
from agv_motion.probe.tables.table_parameters import TableParameters

NAMED = TableForm(',', 1, 1, 4, (0,), (1, 3), ('time', 'a', 'b'))


def form(*text, **given):
    lines = [FileLine(number, line) for number, line in enumerate(text, 1)]
    return find_form(lines, TableParameters(**{'columns': ('a', 'b')} | given), Path('x.csv'))


@pytest.mark.parametrize('delimiter', ',;\t|')
def test_the_delimiter_is_the_one_under_which_all_names_are_there(delimiter):
    head = delimiter.join(('time', 'a', 'rain', 'b'))
    assert form('Oak, in the yard; 2 m', head) == NAMED._replace(
        delimiter=delimiter, header=2, begin=2
    )


def test_blanks_are_one_however_many_and_a_clock_may_follow_its_date_under_one_name():
    found = form('time   a rain\t b', '2015-06-15  11:00 1  2 3')
    assert found.delimiter == ' '
    assert found._replace(width=4).split('2015-06-15  11:00 1\t2 3') == [
        '2015-06-15 11:00', '1', '2', '3',
    ]  # fmt: skip
    assert found._replace(width=4).split('11:00 1 2 3') == ['11:00', '1', '2', '3']


def test_a_first_line_of_excel_tells_the_delimiter_and_is_passed_over():
    assert form('sep=|', 'time|a|b') == TableForm('|', 2, 2, 3, (0,), (1, 2), ('time', 'a', 'b'))
    found = form('sep=!', '11:00!7!8', time_column='1', columns=('3', '2'))
    assert found == TableForm('!', 0, 1, 3, (0,), (2, 1))


def test_a_header_may_be_a_comment_and_lines_that_are_passed_over_hold_none():
    assert form('# time,a,rain,b') == NAMED
    found = form('time,a,b', 'time,b,a', skip_lines=1)
    assert (found.header, found.columns) == (2, (2, 1))


def test_a_time_of_several_columns_unless_one_has_the_whole_name():
    assert form('clock,a,date,b', time_column='date + clock').time == (2, 0)
    assert form('clock,a,date + clock,date,b', time_column='date + clock').time == (2,)


def test_a_row_has_as_many_cells_as_there_are_names_unless_all_have_fewer():
    assert form('time,a,b,', '1,2,3').width == 3
    assert form('time,a,b,', '1,2,3', '1,2,3,4').width == 4
    assert form('time,a,b', '1,2,3,4').width == 3


def test_without_names_the_delimiter_is_that_of_most_lines_of_numbers():
    lines = '1,5;2;3', '1,6;x;3', '1,7;2;3,5', '1,8;;'
    found = form(*lines, time_column='1', columns=('2', '3'))
    assert found == TableForm(';', 0, 0, 3, (0,), (1, 2))
    lines = '1|2|3', 'off|2|3', 'off|2|3', '11:00;2;3', '11:10;NA;3'
    assert form(*lines, time_column='1', columns=('2', '3')).delimiter == ';'
    assert form('title', time_column='1', columns=('3', '2')) == TableForm(
        ',', 0, 0, 3, (0,), (2, 1)
    )


def test_names_and_numbers_of_columns_may_be_mixed():
    assert form('time,b,x', columns=('3', 'b')).columns == (2, 1)
    with pytest.raises(ConfigurationError, match="no column '4'"):
        form('time,b,x', columns=('4', 'b'))


@pytest.mark.parametrize(
    ('lines', 'match'),
    [
        (('time,a,c',), "x.csv, line 1.*no column 'b': it has time, a, c; or give the numbers"),
        (('title', 'clock,a,b', '1,2,3'), "line 2.*no column 'time'"),
        (('time,a,b,a',), "column 'a' is there 2 times.*by its number, 2 or another"),
        ((), 'line 1.*no line with any column: the file is empty'),
        ((*('x',) * HEAD, 'time,a,b'), "no column 'time'"),
    ],
)
def test_a_column_that_is_not_there_or_twice_is_an_error(lines, match):
    with pytest.raises(ConfigurationError, match=match):
        form(*lines)


def test_a_header_that_comes_again_counts_from_there():
    again = NAMED.under(FileLine(9, 'b,time'), '#')
    assert again == NAMED._replace(header=9, width=2, time=(1,), columns=(-1, 0))
    assert NAMED.under(FileLine(9, '#time,a,rain,b'), '#') == NAMED._replace(header=9)
    for none in 'a,b', '"time,a,rain,b', 'timer,a,b':
        assert NAMED.under(FileLine(9, none), '#') is None
    two = NAMED._replace(width=3, time=(0, 2), columns=(1,), names=('time', 'clock', 'a'))
    assert two.under(FileLine(9, 'time,a'), '#') is None
    numbered = NAMED._replace(names=('1', 'a', 'b'))
    assert numbered.under(FileLine(9, '1,2,3,4'), '#') is None
    assert NAMED._replace(names=()).under(FileLine(9, 'time,a,rain,b'), '#') is None


def test_a_quotation_keeps_a_delimiter_and_ends_in_its_line():
    assert split(' 1 , "a, b" ,3', ',') == ['1', 'a, b', '3']
    assert split('1,"a"  ,3', ',') == ['1', 'a', '3']
    with pytest.raises(csv.Error, match='unexpected end of data'):
        split('1,"a,3', ',')


@pytest.mark.parametrize(
    ('cell', 'told'), [('1,5', True), ('-2e3', True), ('1,5,2', False), ('', False)]
)
def test_a_number_has_a_point_or_one_comma(cell, told):
    assert is_number(cell) is told
