"""Files as people have them: each is read as a person reads it, by the parameters named here."""

from __future__ import annotations

from math import nan

import numpy as np

from agv_motion.errors import AgvMotionError
from agv_motion.probe.tables import TableParameters, read_tables
from agv_motion.probe.tables.inspection import inspect

DAWN, HALF = 1_370_822_400.0, 1800.0
"""[s] since 1970: 2013-06-10, when all files here begin; and half an hour"""
COLUMNS = 'probe_1', 'probe_2'
HOURS = 'h%Hm%M %Y/%d/%m'
TWO = [(0.4, 0.5), (0.41, 0.51)]
EVERY_HALF_HOUR = [DAWN, DAWN + HALF]


def table(*times, names='time,probe_1,probe_2', delimiter=','):
    """Return a file with these times."""
    lines = [names, *(f'{t},{a:.3f},{b:.3f}' for t, (a, b) in zip(times, TWO, strict=True))]
    return '\n'.join(lines).replace(',', delimiter) + '\n'


ISO = table('2013-06-10 00:00', '2013-06-10 00:30')
TOA5 = """"TOA5","oak","CR1000","1234","CR1000.Std.31","CPU:sap.CR1","999","Sap"
"TIMESTAMP","RECORD","probe_1","probe_2"
"TS","RN","mV","mV"
"","","Avg","Avg"
"2013-06-10 00:00:00",0,0.4,0.5
"2013-06-10 00:30:00",1,0.41,"NAN"
"""
AMERIFLUX = """# Site: CA-Oak
# Version: 1-5
TIMESTAMP_START,TIMESTAMP_END,SAP_DT_1,SAP_DT_2
201306100000,201306100030,0.4,0.5
201306100030,201306100100,0.41,-9999
"""
SAPFLUXNET = """TIMESTAMP,solar_TIMESTAMP,probe_1,probe_2
2013-06-10T00:00:00Z,2013-06-09T23:31:10Z,0.4,0.5
2013-06-10T00:30:00Z,2013-06-10T00:01:10Z,0.41,NA
"""
EXCHANGED = (
    TOA5.rpartition('"2013')[0]
    + TOA5.rpartition('"2013')[0]
    .partition('"2013')[0]
    .replace('probe_1","probe_2', 'T_air","probe_2","probe_1')
    + '"2013-06-10 00:30:00",1,21.5,"NAN",0.41\n'
)
NEWEST_FIRST = """time,probe_1,probe_2
2013-06-10 00:30,0.41,0.51
2013-06-10 00:00,0.4,0.5
"""

# name: text or bytes, parameters, times since dawn [s], last value of the second probe
KINDS = {
    'ISO': (ISO, {}),
    'ISO with seconds': (table('2013-06-10 00:00:00', '2013-06-10 00:30:00'), {}),
    'ISO with T and Z': (table('2013-06-10T00:00:00Z', '2013-06-10T00:30:00Z'), {}),
    'ISO with fractions': (table('2013-06-10T00:00:00.000Z', '2013-06-10 00:30:00.0'), {}),
    'ISO with offset': (table('2013-06-10T02:00:00+02:00', '2013-06-10T02:30+0200'), {}),
    'compact ISO': (table('20130610T000000', '20130610T003000'), {}),
    'ISO with slashes': (table('2013/06/10 00:00', '2013/06/10 00:30'), {}),
    'without leading zeros': (table('2013-6-10 0:00', '2013-6-10 0:30'), {}),
    'day first with dots': (table('10.06.2013 00:00', '10.06.2013 00:30'), {}),
    'day first with slashes': (
        table('10/06/2013 00:00', '10/06/2013 00:30'), {'time_format': 'day_first'},
    ),
    'day first, short year': (
        table('10.06.13 00:00:00', '10.06.13 00:30:00'), {'time_format': 'day_first'},
    ),
    'month first': (
        table('06/10/2013 00:00', '06/10/2013 00:30'), {'time_format': 'month_first'},
    ),
    'US with AM and PM': (
        table('6/10/2013 12:00:00 AM', '6/10/2013 12:30:00 AM'), {'time_format': 'month_first'},
    ),
    'name of the month': (table('10-Jun-2013 00:00', '10-Jun-2013 00:30'), {}),
    'name of the month first': (table('Jun 10 2013 00:00', 'June 10 2013 12:30 am'), {}),
    'a pattern': (table('h00m00 2013/10/06', 'h00m30 2013/10/06'), {'time_format': HOURS}),
    'YYYYMMDDHHMM': (table('201306100000', '201306100030'), {'time_format': 'YYYYMMDDHHMM'}),
    'YYYYMMDDHHMMSS': (
        table('20130610000000', '20130610003000'), {'time_format': 'YYYYMMDDHHMMSS'},
    ),
    'epoch in seconds': (table('1370822400', '1370824200'), {}),
    'epoch with fractions': (table('1370822400.0', '1370824200.000'), {}),
    'epoch in exponents': (table('1.3708224E9', '1.3708242E9'), {}),
    'epoch in milliseconds': (
        table('1370822400000', '1370824200000'), {'time_format': 'epoch_ms'},
    ),
    'epoch in microseconds': (
        table('1370822400000000', '1370824200000000'), {'time_format': 'epoch_us'},
    ),
    'days of Excel': (table('41435', '41435.0208333'), {'time_format': 'excel'}),
    'days of Excel on an old Macintosh': (
        table('39973', '39973.0208333'), {'time_format': 'excel_1904'},
    ),
    'days of MATLAB': (table('735395', '735395.020833333'), {'time_format': 'matlab'}),
    'date and clock': (
        'day,clock,probe_1,probe_2\n2013-06-10,00:00,0.4,0.5\n2013-06-10,00:30,0.41,0.51\n',
        {'time_column': 'day + clock'},
    ),
    'date with dots and clock': (
        'Datum;Zeit;probe_1;probe_2\n10.06.2013;00:00;0,4;0,5\n10.06.2013;00:30;0,41;0,51\n',
        {'time_column': 'Datum + Zeit'},
    ),
    'year, day of the year, HHMM': (
        'Year,DOY,HHMM,probe_1,probe_2\n2013,161,0,0.4,0.5\n2013,161,30,0.41,0.51\n',
        {'time_column': 'Year + DOY + HHMM'},
    ),
    'year and day with a fraction': (
        'year,doy,probe_1,probe_2\n2013,161.0,0.4,0.5\n2013,161.0208333,0.41,0.51\n',
        {'time_column': 'year + doy'},
    ),
    'a column for each part': (
        'y,mo,d,h,mi,probe_1,probe_2\n2013,6,10,0,0,0.4,0.5\n2013,6,10,0,30,0.41,0.51\n',
        {'time_column': 'y + mo + d + h + mi'},
    ),
    'year, month, day and HHMM': (
        'y,mo,d,hm,probe_1,probe_2\n2013,6,10,00:00,0.4,0.5\n2013,6,10,00:30,0.41,0.51\n',
        {'time_column': 'y + mo + d + hm', 'time_format': '%Y %m %d %H:%M'},
    ),
    'UTC+2': (table('2013-06-10 02:00', '2013-06-10 02:30'), {'time_zone': 'UTC+2'}),
    'UTC-03:30': (table('2013-06-09 20:30', '2013-06-09 21:00'), {'time_zone': '-03:30'}),
    'a zone': (table('2013-06-10 02:00', '2013-06-10 02:30'), {'time_zone': 'Europe/Zurich'}),
    'semicolons': (ISO.replace(',', ';'), {}),
    'semicolons, decimal comma': (ISO.replace(',', ';').replace('.', ','), {}),
    'tabs': (ISO.replace(',', '\t'), {}),
    'tabs, decimal comma': (ISO.replace(',', '\t').replace('.', ','), {}),
    'pipes': (ISO.replace(',', '|'), {}),
    'blanks': (ISO.replace(',', '   '), {}),
    'blanks, date and clock named': (
        'date clock probe_1 probe_2\n2013-06-10 00:00 0.4 0.5\n2013-06-10 00:30 0.41 0.51\n',
        {'time_column': 'date + clock'},
    ),
    'a line that names the separator': ('sep=;\n' + ISO.replace(',', ';'), {}),
    'lines of comment': ('# site: yard\n# unit: mV\n' + ISO + '# the end\n', {}),
    'names in a comment': ('# ' + ISO, {}),
    'lines before the names': ('Logger 7\nsite yard, mV\n\n' + ISO, {}),
    'lines to skip': ('time,probe_1,probe_2\nof before,1,2\n' + ISO, {'skip_lines': 2}),
    'no names': (
        ISO.partition('\n')[2], {'time_column': '1', 'columns': ('2', '3')},
    ),
    'no names, semicolons, decimal comma': (
        ISO.partition('\n')[2].replace(',', ';').replace('.', ','),
        {'time_column': '1', 'columns': ('2', '3')},
    ),
    'no names, blanks': (
        ISO.partition('\n')[2].replace(',', ' '), {'time_column': '1 + 2', 'columns': ('3', '4')},
    ),
    'names, and numbers of columns': (ISO, {'columns': ('2', '3')}),
    'quotations': (
        '"time", probe_1 ,"probe_2" \n"2013-06-10 00:00","0.4", 0.5\n2013-06-10 00:30,0.41,0.51',
        {},
    ),
    'ends of CR LF': (ISO.replace('\n', '\r\n'), {}),
    'ends of CR': (ISO.replace('\n', '\r'), {}),
    'commas at the ends': (ISO.replace('\n', ',\n'), {}),
    'more names than cells': (ISO.replace('probe_2', 'probe_2,remark', 1), {}),
    'UTF-8 with its mark': (b'\xef\xbb\xbf' + ISO.encode(), {}),
    'UTF-16': (ISO.encode('utf-16'), {}),
    'UTF-16, big end first': (b'\xfe\xff' + ISO.encode('utf-16-be'), {}),
    'UTF-16 without its mark': (ISO.encode('utf-16-le'), {}),
    'Latin-1': (ISO.replace('probe_2', 'probe_2,T [°C]', 1).encode('latin-1'), {}),
    'NUL bytes of a power cut': (ISO.encode() + b'\0' * 40 + b'\n', {}),
    'a head again, with other columns': (EXCHANGED, {'time_column': 'TIMESTAMP'}, nan),
    'overrange of Campbell': (ISO.replace('0.510', '7999'), {}, nan),
    'days of Excel, decimal comma': (
        'time;probe_1;probe_2\n41435;0,4;0,5\n41435,0208333;0,41;0,51\n', {'time_format': 'excel'},
    ),
    'TOA5 of Campbell': (TOA5, {'time_column': 'TIMESTAMP'}, nan),
    'AmeriFlux': (
        AMERIFLUX,
        {
            'time_column': 'TIMESTAMP_START', 'time_format': 'YYYYMMDDHHMM',
            'columns': ('SAP_DT_1', 'SAP_DT_2'),
        },
        nan,
    ),
    'SAPFLUXNET': (SAPFLUXNET, {'time_column': 'TIMESTAMP'}, nan),
    'newest first': (NEWEST_FIRST, {}),
}  # fmt: skip
SEEN_BY_ITSELF = set(KINDS) - {
    'day first with slashes', 'day first, short year', 'month first', 'US with AM and PM',
    'a pattern', 'year, month, day and HHMM', 'days of Excel, decimal comma',
    'a head again, with other columns',
    'UTC+2', 'UTC-03:30', 'a zone', 'days of Excel', 'lines to skip',
    'days of Excel on an old Macintosh', 'names, and numbers of columns',
}  # fmt: skip
"""Kinds that need nothing which the file itself does not show."""


def written(path, content):
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return str(path)


def fails(kind, path, given_for):
    """Return what is wrong with how a kind of file is read, '' if nothing."""
    content, given, last = (*KINDS[kind], 0.51)[:3]
    file = written(path, content)
    try:
        found = read_tables(given_for(file, given))
    except (ValueError, AgvMotionError) as error:
        return f'{kind}: {error}'
    expected = [[0.4, 0.5], [0.41, last]]
    sound = found.times.tolist() == EVERY_HALF_HOUR
    sound = sound and np.array_equal(found.values, expected, equal_nan=True)
    return '' if sound else f'{kind}: {found.times.tolist()} {found.values.tolist()}'


def test_each_kind_is_read_as_a_person_reads_it(tmp_path):
    def told(file, given):
        return TableParameters(file=file, **({'columns': COLUMNS} | given))

    wrong = [fails(kind, tmp_path / 'probes.csv', told) for kind in KINDS]
    assert not any(wrong), list(filter(None, wrong))


def test_what_is_seen_in_it_reads_it(tmp_path):
    def as_seen(file, _):
        seen = inspect(file)
        (time_format,) = seen.time_formats
        return TableParameters(
            file=file,
            time_column=seen.time_column,
            time_format=time_format,
            columns=tuple((seen.probes() or seen.numbers())[-2:]),
            delimiter=seen.delimiter,
        )

    wrong = [fails(kind, tmp_path / 'probes.csv', as_seen) for kind in sorted(SEEN_BY_ITSELF)]
    assert not any(wrong), list(filter(None, wrong))
