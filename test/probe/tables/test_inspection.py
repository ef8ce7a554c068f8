"""What a file of a logger looks like, before anything of it is taken."""

from __future__ import annotations

import pytest

from agv_motion.errors import SourceError
from agv_motion.probe.tables import inspection
from agv_motion.probe.tables.file_text import FileLine
from agv_motion.probe.tables.inspection import (
    PROBE_WORDS,
    TIME_WORDS,
    Column,
    _clean_share,
    _clock_beside,
    _formats,
    _is_data,
    _require_points,
    _rows,
    _time_of,
    inspect,
    sounds_like,
)


def test_what_is_no_text_is_refused_without_its_bytes_on_the_terminal(tmp_path):
    file = tmp_path / 'bag.csv'
    file.write_bytes(bytes(range(1, 256)) * 12)
    with pytest.raises(SourceError, match='is no table in text: it begins with b') as refused:
        inspect(str(file))
    assert str(refused.value).isprintable()


def test_a_table_with_what_a_power_cut_leaves_is_one(tmp_path):
    file = tmp_path / 'oak.csv'
    rows = [f'2013-06-01T{hour:02}:00:00,0.{500 + hour}\n' for hour in range(24)]
    file.write_text('time,dT\n' + ''.join(rows) + '\0' * 400)
    assert [column.name for column in inspect(str(file)).columns] == ['time', 'dT']


def test_names_of_few_columns_are_found_under_a_longer_line_of_the_station(tmp_path):
    file = tmp_path / 'oak.dat'
    head = '"TOA5","oak","CR1000","1","Std.31","CPU:a.CR1","9","Sap"\n"TIMESTAMP","RECORD","dT"\n'
    rows = ''.join(f'"2013-06-10 00:0{i}:00",{i},0.{4 + i}\n' for i in range(4))
    file.write_text(head + '"TS","RN","mV"\n"","","Avg"\n' + rows)
    seen = inspect(str(file))
    assert seen.time_column == 'TIMESTAMP'
    assert [column.name for column in seen.columns] == ['TIMESTAMP', 'RECORD', 'dT']


def test_decimal_commas_between_commas_are_refused_with_a_remedy(tmp_path):
    file = tmp_path / 'oak.csv'
    file.write_text('time,dT_1,dT_2\n2013-06-10 00:00,0,40,0,50\n2013-06-10 00:30,0,41,-0,51\n')
    with pytest.raises(SourceError, match=r'3 names over rows of 5 cells.*save it with another'):
        inspect(str(file))


def column(name, *cells):
    return Column(name, tuple(map(str, cells)))


@pytest.mark.parametrize(
    ('cells', 'of_numbers'),
    [
        ('1' * 6 + 'x' * 4, True), ('1' * 5 + 'x' * 5, False), ('x', False), ('', False),
        ((*'11', '', 'NAN', 'na', '-9999'), True), (('', 'NAN'), False),
    ],
)  # fmt: skip
def test_a_column_is_of_numbers_if_six_of_ten_cells_are(cells, of_numbers):
    assert column('a', *cells).is_of_numbers() == of_numbers


def test_names_sound_like_probes_and_times_by_one_word_in_them():
    probes = 'dT_1', 'Granier 2', 'SAPFLOW', 'u_mV', 'Volt', 'TDP', 'tdm3', 'probe', 'Delta'
    assert all(sounds_like(name, PROBE_WORDS) for name in probes)
    times = 'TIMESTAMP', 'Datum', 'Uhrzeit', 'heure', 'date', 'Stamp'
    assert all(sounds_like(name, TIME_WORDS) for name in times)
    assert not any(sounds_like(name, PROBE_WORDS + TIME_WORDS) for name in ('air', 'RH', 't', ''))


def test_a_letter_that_is_cut_where_looking_ends_hides_no_encoding(tmp_path, monkeypatch):
    """Looked at are whole lines, unless there is none."""
    file = tmp_path / 'oak.csv'
    begin = 'time,dT\n2013-06-10 00:00,0.4\n2013-06-10 00:30,0.5\n'
    file.write_text(begin + 'äöü\n', encoding='utf-8')
    monkeypatch.setattr(inspection, 'HEAD_BYTES', len(begin) + 3)
    assert inspect(str(file)).encoding == 'utf-8'
    file.write_bytes('1;ä'.encode('latin-1'))
    assert inspect(str(file)).encoding == 'latin-1'


def test_a_header_and_columns_are_told_as_they_are_in_the_file(tmp_path):
    """A row that looks like data is none before three in a row are."""
    file = tmp_path / 'oak.csv'
    rows = ''.join(f'2013-06-10 0{h}:00;0,4\n' for h in range(3))
    file.write_text('# the station\n7;7\ntime;dT_1\n' + rows + 'x;y\n' + rows)
    seen = inspect(str(file))
    assert (seen.header, seen.delimiter, seen.encoding) == (3, 'semicolon', 'utf-8')
    assert [len(one.cells) for one in seen.columns] == [7, 7]
    assert (seen.numbers(), seen.probes(), seen.time_formats) == (['dT_1'], ['dT_1'], ('iso',))
    file.write_text(rows)
    seen = inspect(str(file))
    assert (seen.header, [one.name for one in seen.columns]) == (0, ['1', '2'])
    assert (seen.numbers(), seen.probes(), seen.time_column) == (['2'], [], '1')


def test_a_file_without_a_row_is_refused(tmp_path):
    file = tmp_path / 'oak.csv'
    file.write_text('# nothing\n')
    with pytest.raises(SourceError, match=r'oak\.csv has no row: give a file with a row of names'):
        inspect(str(file))


POINTS = [['2013-06-10 00:00', '0', '40', '0', '50'], ['2013-06-10 00:30', '0', '41', '-0', '51']]


@pytest.mark.parametrize(
    ('names', 'rows', 'told'),
    [
        (['time', 'a', 'b'], POINTS, '3 names over rows of 5 cells'),
        (['time', 'a', 'b'], [['s', 'm', 'V', 'm', 'V'], *POINTS], '3 names over rows of 5 cells'),
        (['time', 'a'], [row[:3] for row in POINTS], '2 names over rows of 3 cells'),
        (['time', 'a', 'b', 'c'], POINTS, ''),
        (['time', '1', 'b'], POINTS, ''),
        (['time', 'a', 'b'], [[*POINTS[0][:4], '5.0']], ''),
        (['time', 'a', 'b'], [[POINTS[0][0], 'x', *POINTS[0][2:]]], ''),
        (['time', 'a', 'b'], [], ''),
    ],
)
def test_whole_numbers_in_pairs_under_a_name_each_are_decimals_in_pieces(names, rows, told):
    found = list(enumerate([['yard'], names, *rows], 7))
    width = len(rows[0]) if rows else 5
    if told:
        with pytest.raises(SourceError, match=f'^x.csv, line 8: {told} of whole numbers: '):
            _require_points(found, width, 'x.csv')
    else:
        _require_points(found, width, 'x.csv')


def test_comments_are_no_rows_unless_they_have_cells():
    lines = [FileLine(n, told) for n, told in enumerate(['# a,b', '# note', 'note', '1,2,"'], 1)]
    assert _rows(lines, ',') == [(1, ['# a', 'b']), (3, ['note'])]
    assert len(_rows([FileLine(n, '1,2') for n in range(900)], ',')) == 500


@pytest.mark.parametrize(
    ('rows', 'share'),
    [
        ([], 0.0),
        ([['a'], ['b'], ['2013-06-10', '1']], 0.0),
        ([['time', 'dT'], ['2013-06-10', '1']], 1.0),
        ([['time', 'dT'], ['a', 'b']], 0.0),
        ([['2013-06-10', '0.4', 'a1'], ['2013-06-10', '', '10:30']], 2 / 3),
        ([['2013-06-10', '0.4', 'a1'], ['2013-06-10', '0.5', 'ok']], 5 / 6),
    ],
)
def test_how_many_cells_are_each_one_thing(rows, share):
    """A row without a number, as the last of the fifth is, is no data."""
    assert _clean_share(list(enumerate(rows))) == pytest.approx(share)


@pytest.mark.parametrize(
    ('cells', 'data'),
    [
        (['10:30', '0.4'], True), (['x', '1', '0.4'], True), (['x', 'y', '1'], False),
        (['10:30', 'x'], False), (['1'], False), ([], False),
    ],
)  # fmt: skip
def test_a_row_of_data_has_a_number_and_a_time_in_its_first_two_cells(cells, data):
    assert _is_data(cells) == data


EPOCHS, VALUES = (1370822400, 1370824200), (0.4, 0.5)
YEARS, DAYS = (2013, 2013), (161, 162)


@pytest.mark.parametrize(
    ('columns', 'names', 'formats'),
    [
        # numbers tell a time where they are first, or are called so
        ([('a', *EPOCHS), ('b', *VALUES)], 'a', ('epoch_s',)),
        ([('v', *VALUES), ('b', *EPOCHS)], '', ()),
        ([('v', *VALUES), ('time', *EPOCHS)], 'time', ('epoch_s',)),
        ([('v', *VALUES), ('b', '2013-06-10', '2013-06-11')], 'b', ('iso',)),
        # as many columns as there are parts, and something after them
        ([('y', *YEARS), ('doy', *DAYS), ('v', *VALUES)], 'y + doy', ('year_day',)),
        ([('v', *VALUES), ('y', *YEARS), ('doy', *DAYS)], '', ()),
        ([('n', 7, 7), ('y', *YEARS), ('doy', *DAYS), ('v', 1.5, 2.5)], 'y + doy', ('year_day',)),
        (
            [('y', *YEARS), ('mo', 6, 6), ('d', 10, 10), ('h', 0, 1), ('v', *VALUES)],
            'y + mo + d + h', ('fields',),
        ),
        (
            [('y', *YEARS), ('mo', 6, 6), ('d', 10, 10), ('h', 0, 0), ('mi', 0, 30), ('s', 1, 2),
             ('v', *VALUES)],
            'y + mo + d + h + mi + s', ('fields',),
        ),
    ],
)  # fmt: skip
def test_which_columns_tell_the_time(columns, names, formats):
    assert _time_of([column(*one) for one in columns]) == (names, formats)


@pytest.mark.parametrize(
    ('words', 'formats'),
    [
        (['2013-06-10'] * 6 + ['x'] * 4, ('iso',)),
        (['2013-06-10'] * 5 + ['x'] * 5, ()),
        (['2013-06-10'] * 9 + ['7999'], ('iso',)),
        (['1370822400'] * 6 + ['7'] * 4, ('epoch_s',)),
        (['1370822400'] * 5 + ['7'] * 5, ()),
        (['06/10/2013'], ('day_first', 'month_first')),
        ([], ()),
    ],
)
def test_a_format_reads_six_of_ten_words(words, formats):
    assert _formats(words) == formats


@pytest.mark.parametrize(
    ('days', 'clocks', 'beside'),
    [
        ('aabb', ('00:00', '00:30', '00:00', '00:30'), 'clock'),
        ('abcd', ('00:00', '00:30', '00:00', '00:30'), ''),  # no day comes again
        (('a', 'a', 'a 00:30', 'b'), ('00:00', '00:30', '1200', '00:30'), ''),
        ('aaaaabbbbb', ('00:00',) * 6 + ('x',) * 4, 'clock'),
        ('aaaaabbbbb', ('00:00',) * 5 + ('x',) * 5, ''),
        ('aabb', ('0000', '0030', '00:00:15', '00:00:15.5'), 'clock'),
    ],
)
def test_a_clock_stands_beside_days_that_come_again(days, clocks, beside):
    first, second = column('day', *days), column('clock', *clocks)
    value = column('v', *('0.4' for _ in days))
    assert _clock_beside(first, [first, value, second]) == beside
