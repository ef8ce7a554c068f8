"""Benchmarks of editing bags, beside pymcap-cli and rosbags-convert, in one run.

    python launch_scripts/benchmarks/benchmark_edits.py [MB]

A bag of that size (300), then each command of both, in turn, as a person starts it: processor time
(user and system) of all of it, and what remains of that without the same command's on a tiny bag,
which is its start; time on the wall, which nothing else on the machine may share; memory at its
peak. Then the writer beside that of foxglove-sdk, and an index of many bags. pip install
"agv_motion[ros,benchmark]" first.
"""

from __future__ import annotations

import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, NamedTuple

import foxglove
import numpy as np
from foxglove.mcap import MCAPCompression, MCAPWriteOptions
from measure import Row, show

from agv_motion.bag.editing.edit import Edit, edit
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter

if TYPE_CHECKING:
    from collections.abc import Iterator

    Command = list[str | Path]

SECOND = 10**9
ROUNDS = 3
BAGS = 100
"""that are indexed"""
MESSAGES, SIZE = 100_000, 300
"""that are written, and the bytes of each"""
TOPICS = (('/odom', 720, 4), ('/imu', 320, 1), ('/scan', 8000, 20), ('/camera', 200_000, 40))
"""of each the bytes of a message, and every which of the ticks has one"""
AGV, PYMCAP, ROSBAGS = 'agv', 'pymcap-cli', 'rosbags-convert'
COMPILED = {k: v for k, v in os.environ.items() if k != 'PYTHONDONTWRITEBYTECODE'}
"""Modules are compiled once, as pip leaves them: else a source tree is compiled by each command."""
TARGETS = {'filter': 'ratio 0.5', 'merge': 'ratio 0.5', 'convert': 'ratio 0.33'}


class Cost(NamedTuple):
    """What a command took."""

    processor: float
    """[s]"""
    wall: float
    """[s]"""
    peak: int
    """[MiB]"""


def write(path: Path, megabytes: float) -> None:
    """Write a bag as robots have: numbers that compress, pictures that do not, a map at first."""
    rng = np.random.default_rng(1)
    pictures = [rng.bytes(200_000) for _ in range(20)]
    with BagWriter(path) as bag:
        topics = [
            (bag.add_topic(name, 'a/msg/A', 'uint8[] x', type_hash=''), size, each)
            for name, size, each in TOPICS
        ]
        written, tick = 0, 0
        while written < megabytes * 1e6:
            for topic, size, each in topics:
                if tick % each == 0:
                    numbers = rng.normal(size=size // 8).round(3).tobytes() if size < 1e5 else b''
                    data = b'\0\1\0\0' + (numbers or pictures[tick // each % 20])
                    bag.write(topic, 1000 * SECOND + tick * SECOND // 200, data)
                    written += len(data)
            tick += 1


def cost(*command: str | Path) -> Cost:
    """Run a command and return what it took.

    Raises:
        RuntimeError: It fails.

    """
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    code = (
        'import os, resource, sys; done = os.spawnvp(os.P_WAIT, sys.argv[1], sys.argv[1:]); '
        'print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss); sys.exit(done)'
    )
    done = subprocess.run(  # noqa: S603 - our own commands
        [sys.executable, '-c', code, *map(str, command)],
        capture_output=True,
        text=True,
        check=False,
        env=COMPILED,
    )
    if done.returncode:
        msg = f'{" ".join(map(str, command))}: {done.stdout}{done.stderr}'
        raise RuntimeError(msg)
    wall, after = time.perf_counter() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Cost(used, wall, int(done.stdout.split()[-1]) >> 10)


class Given(NamedTuple):
    """The same bag in all the forms that commands are given."""

    bag: Path
    tables: Path
    """in sqlite3"""
    odometry: Path
    """one topic of it"""
    others: Path
    """and all the others"""


def given(folder: Path, megabytes: float) -> Given:
    """Make them."""
    one = Given(*(folder / name for name in Given._fields))
    write(one.bag, megabytes)
    cost(AGV, 'bag', 'convert', one.bag, one.tables)
    cost(AGV, 'bag', 'filter', one.bag, one.odometry, '--topics', '/odom')
    cost(AGV, 'bag', 'filter', one.bag, one.others, '--exclude-topics', '/odom')
    return one


def commands(one: Given, folder: Path) -> dict[str, tuple[Command, Command]]:
    """Return our command and the peer's of each comparison; each writes into a new place."""
    file, odometry, others = (
        next(path.glob('*.mcap')) for path in (one.bag, one.odometry, one.others)
    )
    new, theirs, other = folder / 'ours', folder / 'theirs', folder / 'theirs.mcap'
    ours, peer = [AGV, 'bag', 'filter', one.bag, new], [PYMCAP, 'filter', file, other]
    to_mcap = [ROSBAGS, '--src', one.tables, '--dst', theirs, '--dst-storage', 'mcap']
    return {
        'filter one topic': ([*ours, '--topics', '/odom'], [*peer, '-t', '/odom']),
        'filter all but one': ([*ours, '--exclude-topics', '/odom'], [*peer, '-x', '/odom']),
        'merge': (
            [AGV, 'bag', 'merge', one.odometry, one.others, new],
            [PYMCAP, 'merge', odometry, others, '-o', other],
        ),
        'convert to sqlite3': (
            [AGV, 'bag', 'convert', one.bag, new],
            [ROSBAGS, '--src', one.bag, '--dst', theirs, '--dst-storage', 'sqlite3'],
        ),
        'convert to MCAP': (
            [AGV, 'bag', 'convert', one.tables, new, '--compression', 'none'], to_mcap,
        ),
        'convert to MCAP, zstd': (
            [AGV, 'bag', 'convert', one.tables, new],
            [*to_mcap, '--compress', 'zstd', '--compress-mode', 'storage'],
        ),
    }  # fmt: skip


def compared(large: Given, tiny: Given, folder: Path) -> Iterator[Row]:
    """Yield what each command took, beside the peer's."""
    peak = 0
    for (what, both), starts in zip(
        commands(large, folder).items(), commands(tiny, folder).values(), strict=True
    ):
        costs: list[list[Cost]] = [[] for _ in range(4)]
        for _ in range(ROUNDS):
            for command, found in zip((*both, *starts), costs, strict=True):
                shutil.rmtree(folder, ignore_errors=True)
                folder.mkdir()
                found.append(cost(*command))
        ours, theirs, *least = (median(one.processor for one in found) for found in costs)
        wall = [median(one.wall for one in found) for found in costs]
        peer, target = str(both[1][0]), TARGETS[what.split()[0]]
        peak = max([peak, *(one.peak for one in costs[0])])
        yield Row(f'{what}, processor', ours, peer, theirs, target)
        yield Row('..., without the start', ours - least[0], peer, theirs - least[1], target)
        yield Row('..., on the wall', wall[0], peer, wall[1], target)
    yield Row('peak memory of all these, MiB', peak, target='256', plain=True)


def cut(bag: Path, folder: Path) -> Iterator[Row]:
    """Yield what ten seconds in the middle of a bag cost after it was opened."""
    took, used = [], []
    for _ in range(ROUNDS):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        with BagReader(bag) as reader:
            start = (reader.start + reader.end) // 2
            begin, processor = time.perf_counter(), time.process_time()
            edit(
                [reader], folder / 'cut', Edit(spans=((start, start + 10 * SECOND),), latched=True)
            )
            took.append(time.perf_counter() - begin)
            used.append(time.process_time() - processor)
    yield Row('cut 10 s, processor', median(used), target='0.5 s')
    yield Row('..., on the wall', median(took), target='0.5 s')


def index(folder: Path) -> Iterator[Row]:
    """Yield what an index of many bags costs, and a look at it when nothing is new."""
    folder.mkdir()
    for number in range(BAGS):
        write(folder / f'{number}', 1.0)
    first, again = (cost(AGV, 'bag', 'index', folder).processor for _ in range(2))
    yield Row(f'index of {BAGS} bags, processor', first)
    yield Row('..., of which none is new', again)


def written(folder: Path) -> Iterator[Row]:
    """Yield what messages cost on their way into a bag, beside foxglove-sdk's writer in Rust."""
    data = [bytes([i % 251]) * SIZE for i in range(MESSAGES)]
    used: tuple[list[float], list[float]] = ([], [])
    for _ in range(ROUNDS):
        for act, found in zip((_ours, _foxglove), used, strict=True):
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            begin = time.process_time()
            act(folder, data)
            found.append(time.process_time() - begin)
    what = f'{MESSAGES} messages written, processor'
    yield Row(what, median(used[0]), 'foxglove-sdk', median(used[1]), 'ratio 1')


def _ours(folder: Path, data: list[bytes]) -> None:
    with BagWriter(folder / 'ours') as bag:
        topic = bag.add_topic('/a', 'a/msg/A', 'uint8[] x', type_hash='')
        for i, content in enumerate(data):
            bag.write(topic, 1000 * SECOND + i * SECOND // 1000, content)


def _foxglove(folder: Path, data: list[bytes]) -> None:
    context = foxglove.Context()
    schema = foxglove.Schema(name='a/msg/A', encoding='ros2msg', data=b'uint8[] x')
    options = MCAPWriteOptions(compression=MCAPCompression.Zstd, profile='ros2')
    with foxglove.open_mcap(folder / 'a.mcap', context=context, writer_options=options):
        topic = foxglove.Channel('/a', schema=schema, message_encoding='cdr', context=context)
        for i, content in enumerate(data):
            topic.log(content, log_time=1000 * SECOND + i * SECOND // 1000)


def rows(megabytes: float = 300.0) -> list[Row]:
    """Measure everything."""
    place = Path(tempfile.mkdtemp(prefix='agv_motion_'))
    try:
        for name in ('large', 'tiny'):
            (place / name).mkdir()
        large, tiny = given(place / 'large', megabytes), given(place / 'tiny', 0.001)
        new = place / 'new'
        return [
            *cut(large.bag, new), *compared(large, tiny, new), *written(new),
            *index(place / 'season'),
        ]  # fmt: skip
    finally:
        shutil.rmtree(place)


if __name__ == '__main__':
    show(rows(*map(float, sys.argv[1:2])))
