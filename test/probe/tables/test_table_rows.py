"""The rows of a table: each with its cells and the word of its time, or left out and told."""

from __future__ import annotations

from pathlib import Path

import pytest

from agv_motion.probe.tables.file_text import FileLine
from agv_motion.probe.tables.left_out import LeftOut
from agv_motion.probe.tables.table_form import TableForm
from agv_motion.probe.tables.table_rows import Row, TableRows, without_cut_end

FORM = TableForm(',', 1, 1, 3, (0,), (1, 2), ('time', 'a', 'b'))


def numbered(*text):
    return [FileLine(number, line) for number, line in enumerate(text, 1)]


def read(*text, form=FORM):
    left_out = LeftOut(Path('x.csv'))
    return TableRows(form, '#').read(numbered(*text), left_out), left_out.told()


def test_rows_have_their_line_cells_and_word_and_the_rest_is_passed_over():
    rows, told = read('time,a,b', '', '11:00,1,2', '# told, by hand', ',,', '11:10,3,')
    assert rows == [Row(3, ['11:00', '1', '2'], '11:00'), Row(6, ['11:10', '3', ''], '11:10')]
    assert told == ''


def test_rows_are_read_on_under_the_same_header():
    rows, left_out = TableRows(FORM, '#'), LeftOut(Path('x.csv'))
    assert len(rows.read(numbered('time,a,b', '11:00,1,2'), left_out)) == 1
    assert rows.read([FileLine(3, 'yesterday,1,2')], left_out)[0].word == 'yesterday'


def test_a_time_of_several_cells_is_one_word_with_one_blank_between_its_parts():
    form = FORM._replace(width=4, time=(1, 0), columns=(2, 3), names=('date', 'clock', 'a', 'b'))
    rows, _ = read('clock,date,a,b', '11:00,10  June,1,2', form=form)
    assert rows[0].word == '10 June 11:00'


def test_units_under_the_names_are_no_rows_and_a_word_below_them_is():
    rows, told = read('time,a,b', 'TS,mV,mV', ',Avg,Avg', 'x,y,z', 'noon,1,2')
    assert [row.line for row in rows] == [5]
    assert told == ''
    rows, _ = read('time,a,b', '11:00,1,2', 'noon,1,2')
    assert [row.line for row in rows] == [2, 3]
    bare = FORM._replace(header=0, begin=0, names=())
    assert [row.line for row in read('noon,1,2', form=bare)[0]] == [1]


@pytest.mark.parametrize(
    ('line', 'reason'),
    [
        ('11:00,1', '2 cells under 3 columns: it is cut short'),
        ('11:00,1,5,2', '4 cells under 3 columns: a comma in it may be decimal'),
        ('11:00,"1,2', 'no CSV: unexpected end of data'),
    ],
)
def test_a_row_that_does_not_fit_costs_itself_alone(line, reason):
    rows, told = read('time,a,b', line, '11:10,1,2')
    assert [row.line for row in rows] == [3]
    assert told.startswith(f'rows of x.csv left out: 1 (line 2: {reason}')


def test_empty_cells_at_the_end_fit_and_a_line_with_a_fault_is_told_even_if_empty():
    assert read('time,a,b', '11:00,1,2,,')[0] == [Row(2, ['11:00', '1', '2', '', ''], '11:00')]
    left_out = LeftOut(Path('x.csv'))
    assert TableRows(FORM, '#').read([FileLine(2, '', 'a power cut')], left_out) == []
    assert 'line 2: a power cut' in left_out.told()


def test_under_a_later_header_cells_are_where_they_were_under_the_first():
    rows, told = read('time,a,b', '11:00,1,2', 'b,rain,time,a', '4,9,11:10,3')
    assert rows[1] == Row(4, ['11:10', '3', '4'], '11:10')
    assert told == ''


def test_rows_under_a_header_without_a_column_are_left_out_until_one_with_it():
    rows, told = read('time,a,b', 'time,a', '11:00,1', 'time,a,b', '11:10,1,2')
    assert [row.line for row in rows] == [5]
    assert "line 3: no column ['b'] under the header in line 2" in told


def test_rows_under_the_head_of_another_table_of_campbell_are_left_out():
    rows, told = read('time,a,b', '11:00,1,2', '"TOA5","oak"', '11:10,1,2')
    assert [row.line for row in rows] == [2]
    assert 'line 4: under the head in line 3 the names are others' in told


@pytest.mark.parametrize(
    ('cells', 'columns', 'kept'),
    [
        (('0.41', '0.42', '0.4'), (1,), 2),
        (('0.41', '0.42', '0'), (1,), 2),
        (('0.41', '0.42', '0.43'), (1,), 3),
        (('0.41', '', '0.4'), (1,), 2),
        (('0.41', '0.42', ''), (1,), 3),
        (('0.41', '0.42', '0.4'), (0,), 3),
        (('0.42', '0.4'), (1,), 2),
    ],
)
def test_a_last_row_without_end_is_left_out_if_its_last_cell_is_shorter(cells, columns, kept):
    rows = [Row(line, ['11:00', cell], '11:00') for line, cell in enumerate(cells, 2)]
    left_out = LeftOut(Path('x.csv'))
    last = FileLine(len(cells) + 1, '')
    assert without_cut_end(rows, columns, last, left_out) == rows[:kept]
    assert ('left out: 1 (' in left_out.told()) == (kept < len(rows))
    beyond = FileLine(last.number + 1, '')
    assert without_cut_end(rows, columns, beyond, left_out) == rows
