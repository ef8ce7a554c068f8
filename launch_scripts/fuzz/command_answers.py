"""Run a command as it is typed, in this process, and judge its answer about a bag."""

from __future__ import annotations

import os
import re
import signal
import sys
import tempfile
import traceback
from collections import Counter
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple

from mcap.reader import make_reader

from agv_motion.bag.reader import BagReader
from agv_motion.cli.main import main

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from odd_bags import Case, Sent

LONGEST = 20.0
"""[s] that a command may take"""
FILE = tempfile.TemporaryFile


class Answer(NamedTuple):
    """What a command did."""

    status: int
    out: str
    errors: str
    made: object = None
    """what it wrote"""


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Raise a TimeoutError after a while."""

    def ring(*_: object) -> None:
        msg = f'took longer than {seconds} s'
        raise TimeoutError(msg)

    before = signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


@contextmanager
def caught() -> Iterator[list[str]]:
    """Catch what is told on both outputs, by libraries in C too; the list has it at the end."""
    found: list[str] = []
    before = sys.stdout, sys.stderr
    kept = os.dup(1), os.dup(2)
    with FILE('w+') as out, FILE('w+', errors='backslashreplace') as errors:
        try:
            for number, stream in enumerate((out, errors), 1):
                before[number - 1].flush()
                os.dup2(stream.fileno(), number)
            sys.stdout, sys.stderr = out, errors
            yield found
        finally:
            sys.stdout, sys.stderr = before
            for number, stream in enumerate((out, errors), 1):
                os.dup2(kept[number - 1], number)
                os.close(kept[number - 1])
                stream.seek(0)
                found.append(stream.read())


@contextmanager
def as_if_typed(words: Sequence[str]) -> Iterator[None]:
    """Put words behind the name of the command, and all handlers of signals back at the end."""
    numbers = signal.SIGTERM, signal.SIGHUP, signal.SIGINT
    before = sys.argv, [signal.getsignal(number) for number in numbers]
    sys.argv = ['agv', *words]
    try:
        yield
    finally:
        sys.argv = before[0]
        for number, handler in zip(numbers, before[1], strict=True):
            signal.signal(number, handler)


def run(words: Sequence[str]) -> Answer:
    """Run a command as `agv` does, in this process; what nobody caught has status 70."""
    status, error = 0, ''
    with caught() as told, as_if_typed(words), limited(LONGEST):
        try:
            main()
        except SystemExit as end:
            status = int(end.code or 0)
        except TimeoutError as late:
            status, error = 124, str(late)
        except BaseException as defect:  # noqa: BLE001 - that is what is looked for
            status, error = 70, place(defect)
    return Answer(status, told[0], f'{told[1]}{error}')


def place(error: BaseException) -> str:
    """Return what was raised, and where in the package."""
    frames = [f for f in traceback.extract_tb(error.__traceback__) if 'agv_motion/' in f.filename]
    where = [f'{f.filename.rpartition("agv_motion/")[2]}:{f.lineno}' for f in frames[-1:]]
    return f'{type(error).__name__} at {"".join(where)}: {error!s:.200}'


def saved(path: Path) -> Counter[tuple[object, ...]] | None:
    """Return the messages of a bag as mcap's own reader finds them."""
    if not path.is_dir():
        return None
    found: Counter[tuple[object, ...]] = Counter()
    for file in path.glob('*.mcap'):
        with file.open('rb') as stream:
            for schema, channel, message in make_reader(stream).iter_messages():
                kind = schema.name if schema else ''
                about = re.sub(r'_\d+$', '', channel.topic), kind, channel.message_encoding
                times = message.log_time, message.publish_time, message.sequence
                found[(*about, *times, message.data)] += 1
    return found


def written(sent: Sequence[Sent]) -> Counter[tuple[object, ...]]:
    """Return the same of what was written."""
    return Counter(
        (s.topic.name, s.topic.type, s.topic.encoding, s.stamp, s.publish, s.sequence, s.data)
        for s in sent
    )


def made(to: Path) -> object:
    """Return what a command has made, so that it can be compared."""
    found: dict[str, object] = {}
    for path in sorted(to.rglob('*')):
        if path.suffix in {'.csv', '.png', '.yaml'} and path.name != 'metadata.yaml':
            found[path.name] = path.read_bytes()
    again = to / 'again'
    for folder in sorted({path.parent for path in again.rglob('*.mcap')}):  # one, or one a bag
        with BagReader(folder) as bag:
            found[str(folder.relative_to(to))] = [
                (m.connection.topic, m.stamp, m.data) for m in bag.messages()
            ]
    return found


def told(name: str, answer: Answer, bag: Path) -> object:
    """Return what an answer says of the messages, without names and times of this moment."""
    lines = answer.out.replace(str(bag), 'BAG').splitlines()
    about_files = 'Files', 'Bag size', 'Storage', ' '
    if name == 'bag info':
        lines = [line for line in lines if not line.startswith(about_files)]
    elif name == 'bag info names':
        lines.sort()
    elif name == 'bag check':
        lines = [re.sub(r'.* in ', '', line) for line in lines[-1:]]
    elif name in {'bag export', 'bag recover', 'bag plot', 'plot', 'calibrate'}:
        lines = [re.sub(r'/(made )?[^/]+(?=/)', '', line) for line in lines]
    elif name == 'replay':
        lines = re.findall(r'^(\d+) messages', answer.out)
    elif name == 'reprocess':
        lines = [re.sub(r'^\S+|[\d.]+ s', '', line) for line in lines[1:2]]
    return lines


def wrong(name: str, case: Case, answer: Answer, expected: Answer) -> Iterator[str]:
    """Yield what is wrong with an answer; ``expected`` is that to the sound bag."""
    if answer.status not in {0, 1} or 'Traceback' in answer.out + answer.errors:
        yield f'status {answer.status}: {answer.errors[-400:]}'
        return
    if name == 'bag recover' and case.messages is not None:
        yield from unsaved(answer, written(case.messages))
    yield from (refused if answer.status else accepted)(name, case, answer, expected)


def unsaved(answer: Answer, truth: Counter[tuple[object, ...]]) -> Iterator[str]:
    """Yield what is wrong with what was recovered of what was written."""
    found: Any = answer.made or Counter()
    if found.total() > truth.total():
        yield f'{found.total()} are saved of {truth.total()}'
    if answer.status == 0 and found != truth:
        yield f'status 0, and {(truth - found).total()} of {truth.total()} are lost'


def refused(name: str, case: Case, answer: Answer, expected: Answer) -> Iterator[str]:
    """Yield what is wrong with an answer with status 1."""
    text = answer.out + answer.errors
    names = case.path.name, repr(case.path.name)[1:-1]
    compared = name.startswith('bag diff') and re.search('DIFFERENT|not in the|against', text)
    if not compared and not any(part[:80] in text for part in names):
        yield f'the error does not name the file: {text[-300:]}'
    if case.place and expected.status == 0 and not re.search(case.place, text):
        yield f'the error does not name the place: {text[-300:]}'
    if case.valid and expected.status == 0:
        yield f'refused, though nothing is wrong: {text[-300:]}'


def accepted(name: str, case: Case, answer: Answer, expected: Answer) -> Iterator[str]:
    """Yield what is wrong with an answer with status 0."""
    if case.messages is None:
        yield f'status 0 of what is no bag: {answer.out[:300]}'
    elif expected.status != 0:
        yield f'status 0, where a sound bag gives {expected.status}: {expected.errors[:200]}'
    elif name != 'bag recover':
        ours, theirs = (str(told(name, one, case.path)) for one in (answer, expected))
        if ours != theirs:
            yield f'status 0, and it says {ours[:200]} where a sound bag gives {theirs[:200]}'
        elif answer.made != expected.made:
            yield 'status 0, and what it makes is not that of a sound bag'
