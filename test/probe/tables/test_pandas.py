"""Beside pandas: the same files, times to the microsecond and numbers to the last bit.

pandas is told how each file is written; the readers here find out, or are told as little.
"""

from __future__ import annotations

import io
import random
import sys
from datetime import datetime, timedelta, timezone
from pathlib import Path

import numpy as np
import pytest

from agv_motion.probe.tables import TableParameters, read_tables

sys.path.insert(0, str(Path(__file__).parent))
from test_kinds import COLUMNS, KINDS, TOA5, written

pd = None


@pytest.fixture(scope='module', autouse=True)
def _pandas():
    """Import it when the first of these tests is run: it takes half a second, others only list."""
    globals()['pd'] = pytest.importorskip('pandas')


DAY_FIRST, MONTH_FIRST = '%d/%m/%Y %H:%M', '%m/%d/%Y %H:%M'
TABS, SEMICOLONS = {'sep': '\t'}, {'sep': ';'}
COMMA = {'decimal': ','}
NAMELESS = {'header': None, 'names': ['time', *COLUMNS]}


def words(form, column='time'):
    """Return how pandas reads one column of times in a format of its own."""
    return lambda frame: pd.to_datetime(frame[column].str.strip(), format=form, utc=True)


def joined(form, *columns):
    """Return how pandas reads several columns as one word."""
    return lambda frame: pd.to_datetime(
        frame[list(columns)].astype(str).agg(' '.join, axis=1), format=form, utc=True
    )


def number(unit, before='1970-01-01', column='time'):
    """Return how pandas reads numbers since a day; what the digits do not tell is rounded."""

    def read(frame):
        times = pd.Timestamp(before, tz='UTC') + pd.to_timedelta(frame[column], unit=unit)
        return times.dt.round('s') if unit == 'D' else times

    return read


def in_zone(zone):
    return lambda frame: pd.to_datetime(frame['time']).dt.tz_localize(zone)


def year_day(frame):
    begin = pd.to_datetime(frame['year'].astype(str), format='%Y', utc=True)
    return (begin + pd.to_timedelta(frame['doy'] - 1.0, unit='D')).dt.round('s')


def parts(frame):
    named = {'year': frame.y, 'month': frame.mo, 'day': frame.d, 'hour': frame.h}
    return pd.to_datetime(named | {'minute': frame.mi}, utc=True)


def matlab(frame):
    return pd.to_datetime(frame['time'] - 719529.0, unit='D', utc=True).dt.round('s')


ISO = words('ISO8601')
TEXT = {'dtype': {'time': str}}
# name of the kind: what read_csv is told, and how the times are made of the frame
PANDAS = {
    'without leading zeros': ({}, words('%Y-%m-%d %H:%M')),
    'day first with dots': ({}, words('%d.%m.%Y %H:%M')),
    'day first with slashes': ({}, words(DAY_FIRST)),
    'day first, short year': ({}, words('%d.%m.%y %H:%M:%S')),
    'month first': ({}, words(MONTH_FIRST)),
    'US with AM and PM': ({}, words('%m/%d/%Y %I:%M:%S %p')),
    'name of the month': ({}, words('%d-%b-%Y %H:%M')),
    'name of the month first': ({}, words('mixed')),
    'a pattern': ({}, words('h%Hm%M %Y/%d/%m')),
    'YYYYMMDDHHMM': (TEXT, words('%Y%m%d%H%M')),
    'YYYYMMDDHHMMSS': (TEXT, words('%Y%m%d%H%M%S')),
    'epoch in seconds': ({}, number('s')),
    'epoch with fractions': ({}, number('s')),
    'epoch in exponents': ({}, number('s')),
    'epoch in milliseconds': ({}, number('ms')),
    'epoch in microseconds': ({}, number('us')),
    'days of Excel': ({}, number('D', '1899-12-30')),
    'days of Excel on an old Macintosh': ({}, number('D', '1904-01-01')),
    'days of Excel, decimal comma': (SEMICOLONS | COMMA, number('D', '1899-12-30')),
    'overrange of Campbell': ({'na_values': ['7999']}, ISO),
    'days of MATLAB': ({}, matlab),
    'date and clock': ({}, joined('%Y-%m-%d %H:%M', 'day', 'clock')),
    'date with dots and clock': (
        SEMICOLONS | COMMA | {'dtype': {'Datum': str}}, joined('%d.%m.%Y %H:%M', 'Datum', 'Zeit'),
    ),
    'year, day of the year, HHMM': (
        {'converters': {'HHMM': lambda word: word.zfill(4)}},
        joined('%Y %j %H%M', 'Year', 'DOY', 'HHMM'),
    ),
    'year and day with a fraction': ({}, year_day),
    'a column for each part': ({}, parts),
    'year, month, day and HHMM': ({}, joined('%Y %m %d %H:%M', 'y', 'mo', 'd', 'hm')),
    'UTC+2': ({}, in_zone('Etc/GMT-2')),
    'UTC-03:30': ({}, in_zone('-03:30')),
    'a zone': ({}, in_zone('Europe/Zurich')),
    'semicolons': (SEMICOLONS, ISO),
    'semicolons, decimal comma': (SEMICOLONS | COMMA, ISO),
    'tabs': (TABS, ISO),
    'tabs, decimal comma': (TABS | COMMA, ISO),
    'pipes': ({'sep': '|'}, ISO),
    'blanks': ({'sep': r'\s{2,}', 'engine': 'python'}, ISO),
    'blanks, date and clock named': ({'sep': r'\s+'}, joined('%Y-%m-%d %H:%M', 'date', 'clock')),
    'a line that names the separator': (SEMICOLONS | {'skiprows': 1}, ISO),
    'lines of comment': ({'comment': '#'}, ISO),
    'lines before the names': ({'skiprows': 3}, ISO),
    'lines to skip': ({'skiprows': 2}, ISO),
    'no names': (NAMELESS, ISO),
    'no names, semicolons, decimal comma': (NAMELESS | SEMICOLONS | COMMA, ISO),
    'no names, blanks': (
        {'sep': r'\s+', 'header': None, 'names': ['day', 'clock', *COLUMNS]},
        joined('%Y-%m-%d %H:%M', 'day', 'clock'),
    ),
    'names, and numbers of columns': ({}, ISO),
    'quotations': ({'skipinitialspace': True}, ISO),
    'commas at the ends': ({'index_col': False}, ISO),
    'UTF-16': ({'encoding': 'utf-16'}, ISO),
    'UTF-16, big end first': ({'encoding': 'utf-16'}, ISO),
    'UTF-16 without its mark': ({'encoding': 'utf-16-le'}, ISO),
    'Latin-1': ({'encoding': 'latin-1'}, ISO),
    'TOA5 of Campbell': (
        {'skiprows': [0, 2, 3], 'na_values': ['NAN']}, words('ISO8601', 'TIMESTAMP'),
    ),
    'AmeriFlux': (
        {'comment': '#', 'na_values': [-9999], 'dtype': {'TIMESTAMP_START': str}},
        words('%Y%m%d%H%M', 'TIMESTAMP_START'),
    ),
    'SAPFLUXNET': ({}, words('ISO8601', 'TIMESTAMP')),
}  # fmt: skip
CANNOT = {'names in a comment', 'NUL bytes of a power cut', 'a head again, with other columns'}
"""Kinds of which pandas makes other names, or no times."""


def by_pandas(content, how, times):
    """Return times [us since 1970] and the last two columns as pandas reads them."""
    data = content if isinstance(content, bytes) else content.encode()
    frame = pd.read_csv(io.BytesIO(data), **how)
    frame.columns = frame.columns.str.strip()
    columns = [c for c in frame.columns if c in COLUMNS or c.startswith('SAP_DT')]
    frame['us'] = times(frame).astype('datetime64[us, UTC]').astype('int64')
    frame = frame.sort_values('us')
    return frame['us'].to_numpy(), frame[columns].to_numpy(float)


def microseconds(times):
    return np.round(np.asarray(times) * 1e6).astype(np.int64)


def test_pandas_reads_the_same_out_of_each_kind_of_file(tmp_path):
    for kind in sorted(set(KINDS) - CANNOT):
        content, given = KINDS[kind][:2]
        file = written(tmp_path / 'probes.csv', content)
        found = read_tables(TableParameters(file=file, **({'columns': COLUMNS} | given)))
        times, values = by_pandas(content, *PANDAS.get(kind, ({}, ISO)))
        assert microseconds(found.times).tolist() == times.tolist(), kind
        np.testing.assert_array_equal(found.values, values, kind)


RNG = random.Random(18)  # noqa: S311 - instants, no secret
FIRST = datetime(1991, 1, 1, tzinfo=timezone.utc)
INSTANTS = sorted(
    FIRST + timedelta(seconds=RNG.randrange(3_400_000_000), microseconds=RNG.randrange(10**6))
    for _ in range(500)
)  # fmt: skip
"""Of the years 1991 to 2098"""


@pytest.mark.parametrize(
    ('pattern', 'given', 'times'),
    [
        ('%Y-%m-%d %H:%M:%S.%f', {}, ISO),
        ('%Y-%m-%dT%H:%M:%SZ', {}, ISO),
        ('%Y-%m-%d %H:%M:%S+05:30', {}, ISO),
        ('%Y-%m-%dT%H:%M-0330', {}, ISO),
        ('%Y%m%dT%H%M%S', {}, ISO),
        ('%d.%m.%Y %H:%M:%S', {}, words('%d.%m.%Y %H:%M:%S')),
        ('%m/%d/%Y %I:%M:%S %p', {}, words('%m/%d/%Y %I:%M:%S %p')),
        ('%d-%b-%y %H:%M', {'time_format': 'named_month'}, words('%d-%b-%y %H:%M')),
        ('%B %d, %Y %H:%M:%S', {}, words('%B %d, %Y %H:%M:%S')),
        ('%Y%m%d%H%M', {'time_format': 'YYYYMMDDHHMM'}, words('%Y%m%d%H%M')),
        ('%Y %j %H%M', {'time_format': 'year_day'}, words('%Y %j %H%M')),
        ('%j/%Y %H.%M.%S', {'time_format': '%j/%Y %H.%M.%S'}, words('%j/%Y %H.%M.%S')),
    ],
)
def test_a_century_of_instants_reads_alike(pattern, given, times, tmp_path):
    dated = [t for t in INSTANTS if '%y' not in pattern or 2000 < t.year < 2069]
    rows = [f'{t.strftime(pattern)!r}'.replace("'", '"') + f',{i},{i}' for i, t in enumerate(dated)]
    content = '\n'.join(['time,probe_1,probe_2', *rows, ''])
    file = written(tmp_path / 'probes.csv', content)
    found = read_tables(TableParameters(file=file, columns=COLUMNS, **given))
    there, values = by_pandas(content, TEXT, times)
    assert microseconds(found.times).tolist() == there.tolist()
    np.testing.assert_array_equal(found.values, values)


@pytest.mark.parametrize('sign', ['.', ','])
def test_numbers_are_the_same_to_the_last_bit(sign, tmp_path):
    forms = repr, *(f'{{:{form}}}'.format for form in ('.3f', '+.6e', '.17g', '.0f', '012.4f'))
    cells = [
        form(x).replace('.', sign)
        for form in forms
        for _ in range(300)
        for x in [RNG.choice((1.0, 1e-6, 1e6)) * RNG.uniform(-1.0, 1.0)]
    ]
    cells += ['5' + sign, sign + '5', '-0' + sign + '0', '007', '', 'NA', 'NaN', 'null', '#N/A']
    rows = [f'{1370822400 + 60 * i};{cell};1{sign}5' for i, cell in enumerate(cells)]
    content = '\n'.join(['time;probe_1;probe_2', *rows, ''])
    file = written(tmp_path / 'probes.csv', content)
    found = read_tables(TableParameters(file=file, columns=COLUMNS))
    _, values = by_pandas(content, {'sep': ';', 'decimal': sign}, number('s'))
    np.testing.assert_array_equal(found.values, values)
    assert np.isnan(found.values[-5:, 0]).all()


def test_a_year_of_a_logger_with_summer_time_reads_alike(tmp_path):
    """Each half hour of a year as a wall clock in Zurich shows it, the doubled hour in order."""
    there = pd.date_range('2013-01-01', '2014-01-01', freq='30min', tz='Europe/Zurich')
    shown = there.strftime('%Y-%m-%d %H:%M:%S')
    rows = ''.join(f'"{word}",{i},0.4,"NAN"\n' for i, word in enumerate(shown))
    head = ''.join(TOA5.splitlines(keepends=True)[:4])
    file = written(tmp_path / 'oak.dat', head + rows)
    found = read_tables(TableParameters(
        file=file, time_column='TIMESTAMP', columns=COLUMNS, time_zone='Europe/Zurich',
    ))  # fmt: skip
    by_hand = pd.to_datetime(pd.Series(shown)).dt.tz_localize('Europe/Zurich', ambiguous='infer')
    wanted = by_hand.astype('datetime64[us, Europe/Zurich]').astype('int64')
    assert microseconds(found.times).tolist() == wanted.tolist()
    assert found.problem == ''
