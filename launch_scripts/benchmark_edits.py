"""Benchmarks of editing bags, beside pymcap-cli and rosbags-convert, in one run.

launch_scripts/benchmark_edits.py [MB]: a bag of that size (300), then each command of both, in
turn, as a person starts it; processor time (user and system, in seconds, without that of a start
that does nothing) and memory at its peak [MiB]. Then the writer beside that of foxglove-sdk, and an
index of many bags. pip install "agv_motion[benchmark]" first.
"""

from __future__ import annotations

import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median
from typing import NamedTuple

import foxglove
import numpy as np
from foxglove.mcap import MCAPCompression, MCAPWriteOptions

from agv_motion.bag.editing.edit import Edit, edit
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter

SECOND = 10**9
ROUNDS = 3
BAGS = 100
"""that are indexed"""
MESSAGES, SIZE = 100_000, 300
"""that are written, and the bytes of each"""
TOPICS = (('/odom', 720, 4), ('/imu', 320, 1), ('/scan', 8000, 20), ('/camera', 200_000, 40))
"""of each the bytes of a message, and every which of the ticks has one"""
AGV, PYMCAP, ROSBAGS = 'agv', 'pymcap-cli', 'rosbags-convert'


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
    )
    if done.returncode:
        msg = f'{" ".join(map(str, command))}: {done.stdout}{done.stderr}'
        raise RuntimeError(msg)
    wall, after = time.perf_counter() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Cost(used, wall, int(done.stdout.split()[-1]) >> 10)


def pairs(
    bag: Path, tables: Path, folder: Path
) -> dict[str, tuple[list[str | Path], list[str | Path]]]:
    """Return our command and the peer's of each comparison; each writes into a new place."""
    file, new, other = next(bag.glob('*.mcap')), folder / 'ours', folder / 'theirs.mcap'
    filtering, theirs = [AGV, 'bag', 'filter', bag, new], [PYMCAP, 'filter', file, other]
    return {
        'filter one topic': ([*filtering, '--topics', '/odom'], [*theirs, '-t', '/odom']),
        'filter all but one': (
            [*filtering, '--exclude-topics', '/odom'], [*theirs, '-x', '/odom'],
        ),
        'merge': ([AGV, 'bag', 'merge', bag, bag, new], [PYMCAP, 'merge', file, file, '-o', other]),
        'convert to sqlite3': (
            [AGV, 'bag', 'convert', bag, new],
            [ROSBAGS, '--src', bag, '--dst', folder / 'theirs', '--dst-storage', 'sqlite3'],
        ),
        'convert to MCAP': (
            [AGV, 'bag', 'convert', tables, new, '--compression', 'none'],
            [ROSBAGS, '--src', tables, '--dst', folder / 'theirs', '--dst-storage', 'mcap'],
        ),
        'convert to MCAP, zstd': (
            [AGV, 'bag', 'convert', tables, new],
            [ROSBAGS, '--src', tables, '--dst', folder / 'theirs', '--dst-storage', 'mcap',
             '--compress', 'zstd', '--compress-mode', 'storage'],
        ),
    }  # fmt: skip


def compared(bag: Path, folder: Path) -> None:
    """Print each comparison."""
    tables = bag.with_name('tables')
    cost(AGV, 'bag', 'convert', bag, tables)
    starts = {
        AGV: median(cost(AGV, 'bag', 'filter', '-h').processor for _ in range(ROUNDS)),
        PYMCAP: median(cost(PYMCAP, 'filter', '--help').processor for _ in range(ROUNDS)),
        ROSBAGS: median(cost(ROSBAGS, '--help').processor for _ in range(ROUNDS)),
    }
    for what, both in pairs(bag, tables, folder).items():
        costs: tuple[list[Cost], list[Cost]] = ([], [])
        for _ in range(ROUNDS):
            for command, found in zip(both, costs, strict=True):
                shutil.rmtree(folder, ignore_errors=True)
                folder.mkdir()
                found.append(cost(*command))
        ours, theirs = (
            median(one.processor for one in found) - starts[str(command[0])]
            for command, found in zip(both, costs, strict=True)
        )
        wall = [median(one.wall for one in found) for found in costs]
        peak = [max(one.peak for one in found) for found in costs]
        print(
            f'{what:20} {ours:6.2f} s, {both[1][0]} {theirs:6.2f} s: {theirs / ours:.1f} times; '
            f'wall {wall[0]:.2f} and {wall[1]:.2f} s; peak {peak[0]} and {peak[1]} MiB'
        )


def cut(bag: Path, folder: Path) -> None:
    """Print what ten seconds in the middle of a bag cost after it was opened."""
    for _ in range(ROUNDS):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        with BagReader(bag) as reader:
            start = (reader.start + reader.end) // 2
            begin, used = time.perf_counter(), time.process_time()
            edit(
                [reader], folder / 'cut', Edit(spans=((start, start + 10 * SECOND),), latched=True)
            )
            took = time.perf_counter() - begin
        print(f'cut 10 s: {took:.3f} s, {time.process_time() - used:.3f} s of the processor')


def index(folder: Path) -> None:
    """Print what an index of many bags costs, and a look at it when nothing is new."""
    folder.mkdir()
    for number in range(BAGS):
        write(folder / f'{number}', 1.0)
    start = median(cost(AGV, 'bag', 'index', '-h').processor for _ in range(ROUNDS))
    first, again = (cost(AGV, 'bag', 'index', folder).processor - start for _ in range(2))
    print(f'index of {BAGS} bags: {first:.2f} s of the processor; again {again:.2f} s')


def written(folder: Path) -> None:
    """Print what messages cost on their way into a bag, beside foxglove-sdk's writer in Rust."""
    data = [bytes([i % 251]) * SIZE for i in range(MESSAGES)]
    used: tuple[list[float], list[float]] = ([], [])
    for _ in range(ROUNDS):
        for act, found in zip((_ours, _foxglove), used, strict=True):
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            begin = time.process_time()
            act(folder, data)
            found.append(time.process_time() - begin)
    ours, theirs = map(median, used)
    print(
        f'write {MESSAGES} messages: {ours:.3f} s of the processor, foxglove-sdk {theirs:.3f} s: '
        f'{theirs / ours:.2f} times'
    )


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


if __name__ == '__main__':
    place = Path(tempfile.mkdtemp(prefix='agv_motion_'))
    try:
        write(place / 'bag', float(sys.argv[1]) if len(sys.argv) > 1 else 300.0)
        cut(place / 'bag', place / 'new')
        compared(place / 'bag', place / 'new')
        written(place / 'new')
        index(place / 'season')
    finally:
        shutil.rmtree(place)
