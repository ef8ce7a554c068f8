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
