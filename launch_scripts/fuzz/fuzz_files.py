"""The doors through which files and lines of text come: sound ones, damaged at random."""

from __future__ import annotations

import json
import tempfile
from functools import partial
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from agv_motion.bag.bag_files import find
from agv_motion.bag.quality_of_service import OfferedQos
from agv_motion.kinematics.differential_platform import DifferentialBaseParameters
from agv_motion.motion.behavior.memory import Memory, MemoryParameters
from agv_motion.motion.behavior.memory_file import restore as recall
from agv_motion.motion.behavior.memory_file import save
from agv_motion.motion.navigation.zone import Zone
from agv_motion.motion.navigation.zone_file import load_zone
from agv_motion.probe.parameters import ProbeParameters
from agv_motion.probe.probe import Probe
from agv_motion.probe.sources.csv_file import CsvSource
from agv_motion.probe.sources.csv_parameters import CsvParameters
from agv_motion.probe.sources.serial_line import SerialParameters, SerialSource
from agv_motion.probe.state_file import restore
from agv_motion.ros.parameter_file import load_parameters
from agv_motion.route.route_file import load_route
from agv_motion.sequence.sequence_file import load_sequence

if TYPE_CHECKING:
    import random
    from collections.abc import Callable, Iterator

NUMBERS = (
    *('0', '-0', '-1', '1e308', '-1e308', '1e400', '5e-324', '9e15', '1e100', '1_0', '0x_', '08'),
    *('.nan', '.inf', '-.inf', 'nan', 'inf', 'NaN', 'Infinity', 'null', '~', '""', 'true', 'a'),
    *('9' * 400, '-0.' + '9' * 400, '9' * 5000, '1:2:3', '2020-99-99', '²', '٣'),
)  # fmt: skip
PIECES = (
    *('[', ']', '{', '}', ': ', '- ', ',', ';', '\t', '\n', '\r\n', '"', "'", '&a ', '*a'),
    *('!!int ', '!!float ', '!!python/none ', '---\n', '...\n', '# ', '| ', '> ', '? '),
    *('<<: *a', '%YAML 3\n'),
    *('\x00', '\x04', '\ufeff', '\ud800', '\U0001f600', '\x85', '\\', '\\ud800', 'x' * 300),
    *('[' * 200, '{a: ' * 200, '- ' * 200, '{"a":' * 200),
    'a: &a [x,x,x,x,x,x,x,x,x]\nb: &b [*a,*a,*a,*a,*a,*a,*a,*a,*a]\n'
    + ''.join(f'c{i}: &b [*b,*b,*b,*b,*b,*b,*b,*b,*b]\n' for i in range(9)),
)  # fmt: skip

ZONE = (
    'boundary: [[0, 0], [12, 0], [12.5, 9], [0, 9]]\nholes:\n  - [[3, 3], [5, 3], [5, 5]]\n'
    'translation_only: [[[7, 1], [9, 1], [9, 3]]]\nmargin: 0.3\nhome: [9, 6]\n'
)
GEOJSON = json.dumps({
    'type': 'FeatureCollection',
    'features': [
        {'properties': {}, 'geometry': {'type': 'Polygon', 'coordinates': [
            [[0, 0], [12, 0], [12, 9], [0, 9]], [[3, 3], [5, 3], [5, 5]]]}},
        {'properties': {'kind': 'home'}, 'geometry': {'type': 'Point', 'coordinates': [9, 6, 0]}},
    ],
})  # fmt: skip
SEQUENCE = (
    'name: round\ndefaults: {timeout: 30, on_failure: retry 2 then skip, rotate: {speed: 40}}\n'
    'actions:\n  - go_to: {x: 2.0, y: 1.0, heading: 90, speed: 0.4}\n  - rotate: {by: 90}\n'
    '  - {arc: {angle: 90, diameter: 1.0}, timeout: 20, name: bend}\n  - wait: 1.5\n'
    '  - follow_route: {waypoints: [[0, 0], [1, 0], [1, 1]], laps: 2}\n'
    '  - follow_route: {file: r.csv}\n'
)
PARAMETERS = (
    '/**/differential_kinematics:\n  ros__parameters:\n    track: 0.4\n'
    '    wheel_radii: [0.05, 0.05]\n    max_wheel_speed: 2.0\n    report_after: 0.5\n'
)
PROBES = 'time,probe_1,probe_2,probe_3\n' + ''.join(
    f'2013-06-10T00:{i:02d}:00Z,{0.3 + 0.01 * i:.3f},0.31,\n' for i in range(12)
)
METADATA = (
    'rosbag2_bagfile_information:\n  version: 9\n  storage_identifier: mcap\n'
    '  relative_file_paths: [bag_0.mcap]\n  compression_mode: ""\n  message_count: 3\n'
)
QOS = (
    '- {history: keep_last, depth: 10, reliability: reliable, durability: volatile, '
    'deadline: {sec: 9223372036, nsec: 854775807}, liveliness: 1}\n'
)
LINE = '24-06-15 13:05:30 0.750 0.760 0.770'


def damaged(text: str, rng: random.Random) -> bytes:
    """Return a text that was damaged in one of many ways, some of them malicious."""
    for _ in range(rng.choice((0, 1, 1, 1, 2, 3, 8))):
        at = rng.randrange(len(text) + 1)
        end = min(at + rng.choice((0, 0, 1, 3, 20)), len(text))
        kind = rng.randrange(5)
        if kind == 0:
            digits = [i for i, letter in enumerate(text) if letter.isdigit()] or [0]
            at = rng.choice(digits)
            end = at + 1
            while end < len(text) and text[end] in '0123456789.':
                end += 1
            piece = rng.choice(NUMBERS)
        elif kind == 1:
            piece = rng.choice(PIECES)
        elif kind == 2:
            other = rng.randrange(len(text) + 1)
            piece = text[min(at, other) : max(at, other)]
        elif kind == 3:
            piece = chr(rng.choice((rng.randrange(128), rng.randrange(0x3000))))
        else:
            piece, end = '', min(at + rng.randrange(60), len(text))
        text = text[:at] + piece + text[end:]
    data = text.encode('utf-8', 'surrogatepass')
    if rng.random() < 0.1 and data:
        at = rng.randrange(len(data))
        data = data[:at] + bytes([rng.randrange(256)]) + data[at + 1 :]
    return rng.choice((b'', b'\xef\xbb\xbf')) + data if rng.random() < 0.1 else data


def file_door(
    path: Path, sound: str, read: Callable[[Path], object]
) -> Callable[[random.Random], Callable[[], None]]:
    """Return the door of a kind of file."""

    def door(rng: random.Random) -> Callable[[], None]:
        path.write_bytes(damaged(sound, rng))
        return partial(read, path)  # type: ignore[arg-type]

    return door


def read_probes(path: Path) -> None:
    """Play a recording for a while."""
    source = CsvSource(CsvParameters(file=str(path)), 1.0)
    samples = [*source.history(0.0), *source.read(0.0), *source.read(1e6)]
    assert all(isfinite(sample.time) for sample in samples)
    assert not any(np.isinf(sample.values).any() for sample in samples)


def read_state(path: Path) -> None:
    """Give probes a state, and a reading."""
    probes = [Probe(ProbeParameters()) for _ in range(2)]
    restore(path, probes)
    for probe in probes:
        reading = probe.update(1434366000.0, 9.0)
        known = (reading.zero_flow, reading.flow_index, reading.flux_density, reading.sap_flow)
        assert all(value is None or isfinite(value) for value in known)


def read_zone(path: Path) -> None:
    """Ask a zone for places."""
    zone = load_zone(path)
    assert isfinite(zone.area)
    assert all(map(isfinite, zone.bounds))
    assert isfinite(zone.edge_distance(1.0, 2.0))


class Line:
    """A serial line on which something has come, in place of the real one."""

    def __init__(self, data: bytes) -> None:
        """Keep what has come."""
        self.data = data

    def read(self, _: int) -> bytes:
        """Return what has come, once."""
        data, self.data = self.data, b''
        return data

    def close(self) -> None:
        """Leave it."""


def read_line(data: bytes) -> None:
    """Read lines, each of which is a sample or told."""
    source = SerialSource(SerialParameters(port='fuzzed'))
    source._line = Line(data + b'\r\n' + data[:60] + b'\n')  # type: ignore[assignment] # noqa: SLF001
    samples = source.read(1434366000.0)
    assert all(isfinite(sample.time) for sample in samples)
    assert not any(np.isinf(sample.values).any() for sample in samples)
    source.complaint()


def sound_state() -> str:
    """Return the state of two probes that have seen a few days."""
    probes = [Probe(ProbeParameters()) for _ in range(2)]
    for probe in probes:
        probe.warm_up((1434366000.0 + 9e3 * i, 9.0 + 0.1 * (i % 9)) for i in range(40))
    return json.dumps({'version': 1, 'probes': [probe.state() for probe in probes]})


def flipped(sound: bytes, rng: random.Random) -> bytes:
    """Return bytes of which some are others, gone, or too many."""
    data = bytearray(sound)
    for _ in range(rng.choice((0, 1, 1, 2, 5))):
        at = rng.randrange(len(data))
        if rng.random() < 0.7:
            data[at] ^= 1 << rng.randrange(8)
        else:
            data[at : at + rng.randrange(20)] = bytes(rng.randrange(9))
    return bytes(data)


def memory_door(folder: Path) -> Callable[[random.Random], Callable[[], None]]:
    """Return the door of the memory of places: bytes, not text."""
    zone = Zone([[0, 0], [4, 0], [4, 3], [0, 3]])
    make = partial(Memory, zone, MemoryParameters())
    path = folder / 'places.npz'
    save(path, make().grid())
    sound = path.read_bytes()
    without_digest = sound.partition(b'\n')[2] if sound.startswith(b'agv_motion') else sound

    def door(rng: random.Random) -> Callable[[], None]:
        path.write_bytes(flipped(rng.choice((sound, without_digest)), rng))

        def act() -> None:
            memory = make()
            recall(path, memory)
            assert not np.isinf(memory.flow).any()

        return act

    return door


def doors() -> Iterator[tuple[str, Callable[[random.Random], Callable[[], None]]]]:
    """Yield the doors by name."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for kind in ('bag', 'state'):
            (folder / kind).mkdir()
        (folder / 'bag' / 'bag_0.mcap').touch()
        (folder / 'r.csv').write_text('0,0\n3,0\n')
        base = partial(
            load_parameters, node='differential_kinematics', kind=DifferentialBaseParameters
        )
        yield 'file zone.yaml', file_door(folder / 'zone.yaml', ZONE, read_zone)
        yield 'file zone.geojson', file_door(folder / 'zone.geojson', GEOJSON, read_zone)
        route = 'waypoints: [[0, 0], [4.5, 0], [4, 3]]\nlaps: 2\n'
        yield 'file route.yaml', file_door(folder / 'route.yaml', route, load_route)
        route = 'x,y,t\n0,0,1\n4.5,0,2\n4,3,3\n'
        yield 'file route.csv', file_door(folder / 'route.csv', route, load_route)
        yield 'file sequence.yaml', file_door(folder / 'sequence.yaml', SEQUENCE, load_sequence)
        yield 'file parameters.yaml', file_door(folder / 'parameters.yaml', PARAMETERS, base)
        yield 'file probes.csv', file_door(folder / 'probes.csv', PROBES, read_probes)
        yield 'file state.json', file_door(folder / 'state' / 's.json', sound_state(), read_state)
        yield 'file memory.npz', memory_door(folder / 'state')
        bag = folder / 'bag' / 'metadata.yaml'
        yield 'file metadata.yaml', file_door(bag, METADATA, lambda path: find(path.parent))
        yield (
            'text qos',
            lambda rng: partial(OfferedQos.from_yaml, damaged(QOS, rng).decode(errors='replace')),
        )
        yield 'line serial', lambda rng: partial(read_line, damaged(LINE, rng))
