"""Fuzz what loggers send: lines of every format, and tables of every kind, sound, damaged and odd.

launch_scripts/fuzz/fuzz_probes.py [INPUTS] [SEED]: so many in all (1,000,000), nine of ten of them
lines, one of ten a file. Ends with status 1 when something was uncaught, a number came out that is
not finite, a time outside the years of loggers or of its file, a sound file was not read as it was
written, or anything took longer than a second. test/probe/test_fuzz.py is the short form.
"""

from __future__ import annotations

import sys
import tempfile
from datetime import datetime, timezone
from functools import partial
from math import isfinite, isinf
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from fuzz_files import Line, damaged
from fuzzing import fuzz_all

from agv_motion.probe.loss import LossParameters
from agv_motion.probe.parameters import ProbeParameters
from agv_motion.probe.probe import Probe
from agv_motion.probe.sources.csv_file import CsvSource
from agv_motion.probe.sources.csv_parameters import CsvParameters
from agv_motion.probe.sources.serial_line import SerialParameters, SerialSource
from agv_motion.probe.tables.description import describe, parameters_for
from agv_motion.probe.tables.inspection import inspect
from agv_motion.probe.tables.table import read_tables
from agv_motion.probe.tables.time_readers import DAY, EARLIEST, LATEST

if TYPE_CHECKING:
    import random
    from collections.abc import Callable, Iterator

    from agv_motion.probe.sources.source import ProbeSample

NOW = 1_434_366_000.0
"""[s] since 1970, when lines arrive"""
ODD = '0123456789 \t,;:.-+/*TZeE"=|AD#\0\x04\r\nNAn\xff\u0660'
NAMED = r'(?P<time>\S+ \S+) T1=(?P<v1>\S+) T2=(?P<v2>\S+) T3=(?P<v3>\S+)'
LISTED = r'\[(?P<values>.*)\]'
AIR = {'radiation_field': 4, 'vpd_field': 5}

# what a line of each format is like, and the parameters that read it
LINES: dict[str, tuple[str, dict[str, Any]]] = {
    'original': ('24-06-15 13:05:30 0.750 0.760 0.770 400 0.8', AIR),
    'ISO': ('2015-06-24T13:05:30+02:00,0.750,0.760,0.770', {}),
    'epoch': ('1435151130.5;0,750;0,760;0,770', {}),
    'arrival': ('T1:0.750 T2:0.760 T3:0.770', {'format': 'arrival'}),
    'campbell_comma': (
        '110,2015,175,1305,0.750,0.760,0.770,400,0.8', {'format': 'campbell_comma'} | AIR,
    ),
    'campbell_printable': (
        '01+0110. 02+2015. 03+0175. 04+1305. 05+0.750 06+0.760 07+0.770',
        {'format': 'campbell_printable'},
    ),
    'without a year': (
        '01+0110. 02+0175. 03+1305. 04+0.750 05-7999. 06+0.770', {'format': 'campbell_printable'},
    ),
    'datataker': (
        'D,081044,"JOB1",2015/06/24,13:05:30,0.000366,0;A,0,0.750,0.760,0.770;0071;42AB',
        {'format': 'datataker'},
    ),
    'named groups': (
        'at 24.06.2015 13:05 T1=0,750 T2=0,760 T3=0,770',
        {'format': NAMED, 'time_format': 'day_first'},
    ),
    'listed': ('x [0.750, 0.760, 0.770]', {'format': LISTED}),
    'checksum': ('24-06-15 13:05:30 0.750 0.760 0.770*41', {'checksum': 'xor'}),
}  # fmt: skip


class Tables(NamedTuple):
    """How the times of tables are written, and the parameters that read them."""

    pattern: str
    """of `datetime.strftime`; empty: seconds since 1970"""
    given: dict[str, Any]


TABLES = {
    'ISO': Tables('%Y-%m-%d %H:%M:%S', {}),
    'ISO with Z': Tables('%Y-%m-%dT%H:%M:%SZ', {}),
    'epoch': Tables('', {}),
    'day_first': Tables('%d.%m.%Y %H:%M:%S', {'time_format': 'day_first'}),
    'month_first': Tables('%m/%d/%Y %I:%M:%S %p', {'time_format': 'month_first'}),
    'named_month': Tables('%d-%b-%Y %H:%M:%S', {}),
    'digits': Tables('%Y%m%d%H%M%S', {'time_format': 'YYYYMMDDHHMMSS'}),
    'year_day': Tables('%Y %j %H%M', {'time_format': 'year_day'}),
    'pattern': Tables('%Hh%M %Y/%d/%m', {'time_format': '%Hh%M %Y/%d/%m'}),
    'zone': Tables('%Y-%m-%d %H:%M:%S', {'time_zone': 'Europe/Zurich', 'doubled_hour': 'first'}),
}
SIGNS = (',', '.'), (';', ','), ('\t', ','), ('|', '.'), (';', '.')
HEADS = '', 'sep={0}\n', 'Logger 7\n\n', '# site: yard\n', '\ufeff'
ENCODINGS = 'utf-8', 'utf-8', 'utf-8', 'utf-16', 'latin-1', 'utf-16-le'


class Believer:
    """A probe that takes whatever has come, after whatever came before."""

    def __init__(self) -> None:
        """Know nothing."""
        self._probe = Probe(ProbeParameters(loss=LossParameters(900.0, 900.0, 9000.0)))

    def take(self, samples: list[ProbeSample]) -> None:
        """Require times of loggers, and numbers that are finite or none."""
        for sample in samples:
            assert EARLIEST - DAY < sample.time < LATEST + DAY, sample.time
            assert not any(map(isinf, (*sample.values, *sample.environment))), sample
            reading = self._probe.update(sample.time, sample.values[0], sample.environment)
            told = (*reading[3:7], reading.estimate.value)
            assert all(value is None or isfinite(value) for value in told), reading
            for share in (reading.sap_flow, reading.estimate.value):
                assert share is None or 0.0 <= share <= 1.0, reading


def line_door(sound: str, given: dict[str, Any]) -> Callable[[random.Random], Callable[[], None]]:
    """Return the door of lines of one format."""
    parameters, believer = SerialParameters(port='fuzzed', **given), Believer()

    def read(data: bytes) -> None:
        source = SerialSource(parameters)
        source._line = Line(data + b'\n')  # type: ignore[assignment] # noqa: SLF001
        believer.take(source.read(NOW))
        source.complaint()

    def door(rng: random.Random) -> Callable[[], None]:
        kind = rng.randrange(10)
        if kind == 0:
            return partial(read, rng.randbytes(rng.randrange(200)))
        if kind == 1:
            return partial(read, ''.join(rng.choices(ODD, k=rng.randrange(99))).encode())
        at = rng.randrange(len(sound))
        text = sound if kind < 8 else sound[:at] + ''.join(rng.choices(ODD, k=3)) + sound[at + 3 :]
        return partial(read, damaged(text, rng))

    return door


def table_of(rng: random.Random, form: Tables) -> tuple[str, list[float]]:
    """Return a table of some rows, and their times [s since 1970]."""
    delimiter, decimal = rng.choice(SIGNS)
    begin = rng.randrange(int(EARLIEST / 60.0) + 1500, int(LATEST / 60.0) - 1500) * 60
    times = [float(begin + 60 * rng.choice((1, 15, 30)) * k) for k in range(rng.randrange(1, 12))]
    rows = [delimiter.join(('time', 'probe_1', 'probe_2', 'probe_3'))]
    for time in times:
        moment = datetime.fromtimestamp(time, timezone.utc)
        word = moment.strftime(form.pattern) if form.pattern else f'{time:.0f}'
        values = (f'{rng.uniform(0.1, 0.9):.4f}'.replace('.', decimal) for _ in range(3))
        rows.append(delimiter.join((word, *values)))
    head = rng.choice(HEADS).format(delimiter)
    return head + '\n'.join(rows) + rng.choice(('\n', '')), sorted(set(times))


def read_file(path: Path, given: dict[str, Any], times: list[float], *, sound: bool) -> None:
    """Read a file as it is meant, and play it; as it seems; and compare one that is sound."""
    source = CsvSource(CsvParameters(file=str(path), **given), 1.0)
    samples = [*source.history(0.0), *source.read(0.0), *source.read(1e6)]
    Believer().take(samples)
    table = read_tables(CsvParameters(file=str(path), **given).table())
    assert not np.isinf(table.values).any()
    assert np.all(np.diff(table.times) > 0.0)
    told = [sample.time for sample in samples]
    assert all(table.times[0] <= time <= table.times[-1] for time in told)
    if sound and 'time_zone' not in given:
        assert table.times.tolist() == times
        assert np.isfinite(table.values).all()
    assert isfinite(source.period) or len(table.times) == 1


def look_at(path: Path) -> None:
    """Read a file as it seems."""
    seen = inspect(str(path))
    found = parameters_for(seen, {'file': str(path)}, ())
    description = describe(read_tables(found), found.columns)
    assert not any(map(isinf, (c.low for c in description.columns)))
    assert not any(map(isinf, (c.high for c in description.columns)))


def table_door(
    path: Path, form: Tables, *, looked_at: bool
) -> Callable[[random.Random], Callable[[], None]]:
    """Return the door of tables whose times are written in one way."""

    def door(rng: random.Random) -> Callable[[], None]:
        text, times = table_of(rng, form)
        sound = rng.random() < 0.2
        data = text.encode(encoding := rng.choice(ENCODINGS), 'replace')
        if not sound:
            data = damaged(text, rng)
            if encoding != 'utf-8':
                data = data.decode(errors='replace').encode(encoding, 'replace')
        path.write_bytes(data)
        if looked_at:
            return partial(look_at, path)
        return partial(read_file, path, form.given, times, sound=sound)

    return door


def lines() -> Iterator[tuple[str, Callable[[random.Random], Callable[[], None]]]]:
    """Yield the doors of lines by name."""
    for name, (sound, given) in LINES.items():
        yield f'line {name}', line_door(sound, given)


def tables() -> Iterator[tuple[str, Callable[[random.Random], Callable[[], None]]]]:
    """Yield the doors of tables by name."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / 'probes.csv'
        for name, form in TABLES.items():
            yield f'table {name}', table_door(path, form, looked_at=False)
            yield f'table {name}, as it seems', table_door(path, form, looked_at=True)


def main(words: list[str]) -> int:
    """Fuzz, print a table, and return the status."""
    inputs = int(words[0]) if words else 1_000_000
    seed = int(words[1]) if words[1:] else 1
    of_lines = max(1, round(0.9 * inputs / len(LINES)))
    of_tables = max(1, round(0.1 * inputs / (2 * len(TABLES))))
    return fuzz_all(lines(), of_lines, seed) | fuzz_all(tables(), of_tables, seed)


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
