"""Fuzz the readers of bags: any bytes are read or refused, in bounded time and memory.

launch_scripts/fuzz/fuzz_bags.py [SECONDS] [SEED]: the long form of test/bag/test_fuzz.py.
"""

from __future__ import annotations

import random
import resource
import sys
import tempfile
import time
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from agv_motion.bag.catalog.find import Question
from agv_motion.bag.catalog.find import find as ask
from agv_motion.bag.catalog.index import BagIndex
from agv_motion.bag.catalog.statistics import Period, amounts, topic_amounts
from agv_motion.bag.checks.check import Limits, check
from agv_motion.bag.checks.sizes import sizes
from agv_motion.bag.columns.columns import read_topics
from agv_motion.bag.completeness import completeness, together
from agv_motion.bag.editing.recovery import Recovery
from agv_motion.bag.editing.request import EditRequest
from agv_motion.bag.notes import NAME as NOTES
from agv_motion.bag.notes import notes_of
from agv_motion.bag.reader import BagReader
from agv_motion.bag.selection import Selection
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from collections.abc import Callable

LONGEST = 5.0
"""[s] that a look at a small damaged bag may take, on a busy machine"""
MEMORY = 1 << 30
"""[bytes] by which the memory of the process may have grown at its peak"""
HEADER = 'std_msgs/Header header\nstring[] name\nfloat64[] position\n' + (
    '=' * 80 + '\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n'
    + '=' * 80 + '\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n'
)  # fmt: skip
WORDS = (0, 1, 2**15, 2**31 - 1, 2**32 - 1, 2**63 - 1, 2**63, 2**64 - 1)
REQUESTS = (
    EditRequest(), EditRequest(compression='lz4', part_size=0.0005), EditRequest(ordered=True),
    EditRequest(Selection(topics=('/text',)), begin='0.000000005'),
    EditRequest(around='/joints/position > -1'), EditRequest(storage='sqlite3'),
)  # fmt: skip
"""What is asked of every bag."""
TEXTS = (b'string<=9999999999999999999 data', b'a/B b', b'\xff\xfe\x00', b'float64[2147483647] x')


def sound(folder: Path, compression: str) -> bytes:
    """Return the bytes of a small sound bag."""
    path = folder / f'sound_{compression}'
    message = b'\0\1\0\0' + b'\1\0\0\0\2\0\0\0\3\0\0\0ab\0\0' + b'\1\0\0\0\2\0\0\0c\0\0\0'
    message = message.ljust(36, b'\0') + b'\1\0\0\0' + b'\0' * 12
    with BagWriter(path, compression=compression, chunk_size=400) as writer:
        topics = [
            writer.add_topic('/text', 'std_msgs/msg/String', 'string data\n', type_hash=''),
            writer.add_topic('/joints', 'a_msgs/msg/Joints', HEADER, type_hash=''),
        ]
        text = b'\0\1\0\0\4\0\0\0abc\0'
        for i in range(24):
            writer.write(topics[i % 2], 1000 + i, message if i % 2 else text)
    return next(path.glob('*.mcap')).read_bytes()


def damaged(data: bytes, rng: random.Random) -> bytes:
    """Return a bag that was damaged in one of many ways, some of them malicious."""
    wrong = bytearray(data)
    for _ in range(rng.choice((1, 1, 1, 2, 5, 40))):
        at = rng.randrange(len(wrong))
        kind = rng.randrange(6)
        if kind == 0:
            wrong[at] ^= 1 << rng.randrange(8)
        elif kind == 1:
            size = rng.choice((2, 4, 8))
            word = rng.choice(WORDS) % 2 ** (8 * size)
            wrong[at : at + size] = word.to_bytes(size, 'little')[: len(wrong) - at]
        elif kind == 2:
            wrong[at:] = b''
        elif kind == 3:
            end = rng.randrange(at, len(wrong)) + 1
            place = rng.randrange(len(wrong))
            wrong[place:place] = wrong[at:end]
        elif kind == 4:
            text = rng.choice(TEXTS)
            wrong[at : at + len(text)] = text
        else:
            wrong[at : at + rng.randrange(1, 64)] = b''
        if not wrong:
            break
    return bytes(wrong)


def told(path: Path, act: Callable[[], object]) -> None:
    """Do something; only errors of the package may come of it, and they name the file."""
    text = ''
    try:
        act()
    except AgvMotionError as error:
        text = str(error)
    assert not text or path.name in text, text


def messages(path: Path) -> None:
    """Read message by message."""
    with BagReader(path) as bag:
        assert all(isinstance(message.data, bytes) for message in bag.messages())


def columns(path: Path) -> None:
    """Read into columns."""
    with BagReader(path) as bag:
        read_topics(bag)


def careless(path: Path) -> None:
    """Read into columns though CRCs are wrong, so that damage comes further in."""
    with BagReader(path, validate=False) as bag:
        for topic in bag.topics:
            told(path, partial(read_topics, bag, [topic]))


def findings(path: Path) -> None:
    """Look for what is wrong."""
    with BagReader(path) as bag:
        list(check(bag, Limits()))


def looked_at(path: Path, saved: Path) -> None:
    """Read a bag in every way there is."""

    def recovery(path: Path) -> None:
        with BagWriter(saved) as writer:
            Recovery(writer).save(path)

    for act in (messages, columns, careless, findings, recovery, notes, indexed):
        told(path, partial(act, path))
    for number, request in enumerate(REQUESTS):
        told(path, partial(edited, path, saved.with_name(f'{saved.name}_{number}'), request))


def edited(path: Path, new: Path, request: EditRequest) -> None:
    """Make a bag of it; what is made must be whole, and hold nothing that is not read."""
    request.make([path] * (1 + request.ordered), new)
    with BagReader(new) as bag:
        assert not bag.problems, bag.problems
        made = {(m.connection.topic, m.stamp, m.data) for m in bag.messages()}
        assert len(made) <= bag.message_count
    with BagReader(path) as bag:
        read = {(m.connection.topic, m.stamp, m.data) for m in bag.messages()}
    assert made <= read, made - read
    if not (request.begin or request.around or request.topics.topics):
        assert made == read, read - made


def indexed(path: Path) -> None:
    """Put the bag into an index, and ask that."""
    folder = path.with_name(f'season of {path.name}')
    folder.mkdir(exist_ok=True)
    copy = folder / path.name
    copy.write_bytes(path.read_bytes())
    with BagIndex(folder) as index:
        index.update()
        list(ask(index, Question(where='/joints/position > -1'), complain=lambda _: None))
        amounts(index, Question(), Period.DAY, 60.0)
        topic_amounts(index, Question())


def notes(path: Path) -> None:
    """Read the bytes as notes, and what the recorder may have told."""
    place = path.with_name(f'{path.name}.{NOTES}')
    place.write_bytes(path.read_bytes())
    notes_of(path)
    place.unlink()
    with BagReader(path) as bag:
        together(completeness(bag))
        sizes(bag)


def fuzz(seconds: float, seed: int, rounds: int = sys.maxsize) -> int:
    """Damage and read until the time is over; return how many bags were tried.

    Raises:
        AssertionError: A bag took too long, or too much memory.

    """
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    end = time.monotonic() + seconds
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        bags = [sound(folder, compression) for compression in ('none', 'zstd', 'lz4')]
        number = 0
        while time.monotonic() < end and number < rounds:
            data = damaged(bags[number % 3], random.Random(f'{seed} {number}'))  # noqa: S311
            path = folder / 'bag.mcap'
            path.write_bytes(data)
            begin = time.process_time()
            try:
                looked_at(path, folder / f'saved_{number}')
                took = time.process_time() - begin
                grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024
                assert took < LONGEST, f'{took:.1f} s'
                assert grown < MEMORY, f'{grown} bytes more'
            except BaseException:
                kept = Path(tempfile.gettempdir()) / f'fuzz_{seed}_{number}.mcap'
                kept.write_bytes(data)
                sys.stderr.write(f'seed {seed}, number {number}: kept as {kept}\n')
                raise
            number += 1
    return number


if __name__ == '__main__':
    given = [float(word) for word in sys.argv[1:]]
    tried = fuzz(given[0] if given else 600.0, int(given[1]) if len(given) > 1 else 1)
    sys.stdout.write(f'{tried} damaged bags were read or refused\n')
