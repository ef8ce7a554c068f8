"""Several files, folders, and files that grow."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.probe.tables import TableParameters, read_tables
from agv_motion.probe.tables.table import LoggerTables

HEADER = 'time,a\n'
DAWN = 1_370_822_400.0


def rows(*minutes):
    return ''.join(f'2013-06-10 00:{minute:02}:00,{minute}\n' for minute in minutes)


def read(path, **given):
    return read_tables(TableParameters(file=str(path), **({'columns': ('a',)} | given)))


def test_a_folder_and_a_pattern_are_read_in_the_order_of_time(tmp_path):
    (tmp_path / 'b.dat').write_text(HEADER + rows(1, 2))
    (tmp_path / 'a.dat').write_text((HEADER + rows(3, 4)).replace(',', ';'))
    (tmp_path / 'c.csv').write_text(HEADER + rows(5))
    (tmp_path / 'notes.md').write_text('not of a logger')
    assert read(tmp_path).values[:, 0].tolist() == [1, 2, 3, 4, 5]
    found = read(tmp_path / '?.dat')
    assert found.values[:, 0].tolist() == [1, 2, 3, 4]
    assert 'b.dat, line 2' in found.place(0)
    assert 'put into order' in found.problem


def test_of_rows_of_one_time_the_last_counts(tmp_path):
    (tmp_path / '1.csv').write_text(HEADER + rows(1, 2))
    (tmp_path / '2.csv').write_text(HEADER + rows(2, 3).replace(',2', ',20'))
    found = read(tmp_path)
    assert found.values[:, 0].tolist() == [1, 20, 3]
    assert '1 rows of a time that comes again dropped' in found.problem


@pytest.mark.parametrize(
    ('name', 'match'),
    [('', 'ends on .csv'), ('*.dat', 'no file is called'), ('gone.csv', 'cannot read')],
)
def test_no_file_is_an_error(tmp_path, name, match):
    with pytest.raises(SourceError, match=match):
        read(tmp_path / name)


def test_a_pipe_is_refused_and_not_waited_for(tmp_path):
    import os

    os.mkfifo(tmp_path / 'pipe.csv')
    with pytest.raises(SourceError, match='a device or a pipe'):
        read(tmp_path / 'pipe.csv')


@pytest.mark.parametrize('encoding', ['utf-8', 'utf-8-sig', 'utf-16', 'latin-1'])
def test_a_file_that_grows_is_read_on_where_it_was_left(tmp_path, encoding):
    file = tmp_path / 'a.csv'
    first = ('# °\n' + HEADER + rows(1)).encode(encoding)
    plain = {'utf-16': 'utf-16-le', 'utf-8-sig': 'utf-8'}.get(encoding, encoding)
    more = rows(2).encode(plain)
    tables = LoggerTables(TableParameters(file=str(file), columns=('a',)))
    file.write_bytes(first + more[:-7])  # a line that is being written
    assert tables.read(growing=True).values[:, 0].tolist() == [1]
    assert len(tables.read(growing=True).times) == 0
    file.write_bytes(first + more)
    found = tables.read(growing=True)
    assert found.values[:, 0].tolist() == [2]
    assert found.place(0) == 'line 4'
    file.write_bytes((HEADER + rows(3)).encode(encoding))  # begun anew
    assert tables.read(growing=True).values[:, 0].tolist() == [3]


def test_new_files_of_a_folder_are_found_and_empty_ones_waited_for(tmp_path):
    tables = LoggerTables(TableParameters(file=str(tmp_path), columns=('a',)))
    (tmp_path / '1.csv').write_text(HEADER + rows(1))
    assert len(tables.read(growing=True).times) == 1
    (tmp_path / '2.csv').write_text('')
    assert len(tables.read(growing=True).times) == 0
    (tmp_path / '2.csv').write_text(HEADER[:3])
    assert len(tables.read(growing=True).times) == 0
    (tmp_path / '2.csv').write_text(HEADER + rows(2))
    assert tables.read(growing=True).times.tolist() == [DAWN + 120.0]


def test_a_column_that_is_not_there_names_those_that_are(tmp_path):
    (tmp_path / 'a.csv').write_text(HEADER + rows(1))
    with pytest.raises(ConfigurationError, match="no column 'b': it has time, a; or give"):
        read(tmp_path / 'a.csv', columns=('b',))
    with pytest.raises(ConfigurationError, match="no column '3'"):
        read(tmp_path / 'a.csv', columns=('3',))


def test_a_header_without_a_column_ends_it_until_one_with_it(tmp_path):
    file = tmp_path / 'oak.csv'
    parts = HEADER, rows(1), 'time,b\n', rows(2, 3), '"TOA5","oak"\n', rows(4), 'b,time,a\n'
    file.write_text(''.join(parts) + '7,2013-06-10 00:05,5\n')
    found = read(file)
    assert found.values[:, 0].tolist() == [1, 5]
    assert "left out: 3 (line 4: no column ['a'] under the header in line 3" in found.problem
    assert 'line 7: under the head in line 6 the names are others' in found.problem


@pytest.mark.parametrize('record', ['1', '2', '3'])
def test_a_row_is_no_header_since_a_number_of_it_is_that_of_a_column(tmp_path, record):
    file = tmp_path / 'oak.csv'
    file.write_text(f'0.5,2013-06-10 00:01,0.4\n{record},2013-06-10 00:02,0.41\n')
    found = read(file, time_column='2', columns=('3', '1'))
    assert found.values.tolist() == [[0.4, 0.5], [0.41, float(record)]]
    assert found.problem == ''


@pytest.mark.parametrize(
    ('last', 'kept'),
    [('0.43', 4), ('0.4', 3), ('0.', 3), ('0.4\n', 4), ('', 4), ('0.433', 4), ('0.4,x', 3)],
)
def test_a_last_cell_that_is_cut_is_left_out_and_told(tmp_path, last, kept):
    file = tmp_path / 'oak.csv'
    begun = ''.join(f'2013-06-10 00:0{i},0.4{i}\n' for i in range(3))
    file.write_text(HEADER + begun + '2013-06-10 00:03,' + last)
    found = read(file)
    assert len(found.times) == kept
    assert ('left out: 1 (line 5' in found.problem) == (kept == 3)


@pytest.mark.parametrize(
    ('data', 'remedy'),
    [
        (b'PK\x03\x04\x14\x00\x06\x00', 'save it as CSV'),
        (b'\x1f\x8b\x08\x00\x00\x00\x00\x00', 'gunzip it'),
        (b'"TOB1","oak","CR1000"\r\n', 'convert it to TOA5'),
        (bytes(range(1, 32)) * 20, 'it begins with'),
    ],
)
def test_what_is_no_text_is_refused_with_its_remedy(tmp_path, data, remedy):
    file = tmp_path / 'oak.csv'
    file.write_bytes(data)
    with pytest.raises(SourceError, match=f'no table in text.*{remedy}'):
        read(file)


def test_a_million_digits_cost_no_square_of_it(tmp_path):
    """They would take an hour."""
    file = tmp_path / 'oak.csv'
    file.write_text(HEADER + rows(1) + '2013-06-10 00:02,' + '7' * 1_000_000 + 'x\n')
    assert read(file).values[0, 0] == 1


@pytest.mark.parametrize('head', [HEADER, 'b,time,a\n'])
def test_another_file_of_the_same_name_is_read_from_its_begin(tmp_path, head):
    file = tmp_path / 'oak.csv'
    file.write_text(HEADER + rows(1, 2))
    tables = LoggerTables(TableParameters(file=str(file), columns=('a',)))
    assert tables.read(growing=True).values[:, 0].tolist() == [1, 2]
    other = rows(*range(3, 9))
    file.write_text(head + (other if head == HEADER else other.replace('2013', '7,2013')))
    assert tables.read(growing=True).values[:, 0].tolist() == [3, 4, 5, 6, 7, 8]


@pytest.mark.parametrize('encoding', ['utf-8', 'utf-16-le'])
def test_lines_that_end_in_cr_alone_grow_too(tmp_path, encoding):
    file = tmp_path / 'oak.csv'
    file.write_bytes((HEADER + rows(1)).replace('\n', '\r').encode(encoding))
    tables = LoggerTables(TableParameters(file=str(file), columns=('a',)))
    assert tables.read(growing=True).values[:, 0].tolist() == [1]
    with file.open('ab') as written:
        written.write((rows(2).replace('\n', '\r') + '2013').encode(encoding))
    assert tables.read(growing=True).values[:, 0].tolist() == [2]


def test_a_file_that_is_not_there_is_told(tmp_path):
    tables = LoggerTables(TableParameters(file=str(tmp_path / 'oak.csv'), columns=('a',)))
    for growing in (False, True):
        with pytest.raises(SourceError, match=r'cannot read the probe file .*oak\.csv'):
            tables.read(growing=growing)


def test_a_file_that_cannot_be_read_costs_no_row_of_the_others(tmp_path):
    (tmp_path / 'a.csv').write_text(HEADER + rows(1))
    tables = LoggerTables(TableParameters(file=str(tmp_path), columns=('a',)))
    assert tables.read(growing=True).values[:, 0].tolist() == [1]
    (tmp_path / 'b.txt').write_text('notes\n')
    with (tmp_path / 'a.csv').open('a') as written:
        written.write(rows(2))
    (tmp_path / 'c.csv').write_text(HEADER + rows(3))
    found = tables.read(growing=True)
    assert found.values[:, 0].tolist() == [2, 3]
    assert "b.txt, line 1, column 1: no column 'time'" in found.problem
    with pytest.raises(ConfigurationError, match=r'b\.txt'):
        read(tmp_path)


def test_a_time_that_is_none_is_told_with_its_column(tmp_path):
    file = tmp_path / 'oak.csv'
    file.write_text('probe,b,time\n' + 2 * '12,345,2100-01-01\n')
    with pytest.raises(SourceError, match=r'oak\.csv, line 2, column 8: '):
        read_tables(TableParameters(file=str(file), columns=('probe',)))
