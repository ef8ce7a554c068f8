"""Run `agv` in a process of its own, and end it at a moment that a share of its way tells.

A moment is told by what the process has done (changes of files, names that have appeared, bytes
written), so that it does not depend on the speed of the machine; by the clock only where asked.
"""

from __future__ import annotations

import importlib
import io
import os
import resource
import signal
import subprocess
import sys
import threading
import time
import traceback
from contextlib import suppress
from functools import cache
from pathlib import Path
from pkgutil import walk_packages
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn

import agv_motion.cli

if TYPE_CHECKING:
    from collections.abc import Callable

PERIOD, IDLE = 0.001, 0.01
"""[s] between two looks at what a process has written, and at whether it has ended"""
LONGEST = 120.0
"""[s] that a run may take"""
PATIENCE = 20.0
"""[s] within which everything ends after the first process has"""
CHANGES = frozenset((
    'write', 'pwrite', 'writerow', 'writerows', 'flush', 'close', 'fsync', 'fdatasync', 'ftruncate',
    'mkdir', 'rmdir', 'rename', 'replace', 'unlink', 'remove', 'chmod', 'flock',
    'execute', 'executemany', 'executescript', 'commit',
))  # fmt: skip
"""Names of the functions in C that change files; before and after each a process can be ended."""
IN_MEMORY = str, io.StringIO, io.BytesIO
"""what has such functions too, and changes no file"""
KILL, INTERRUPT, TERMINATE, FULL, WORKER = 'KILL', 'INT', 'TERM', 'full disk', 'worker killed'
NUMBERS = {KILL: signal.SIGKILL, INTERRUPT: signal.SIGINT, TERMINATE: signal.SIGTERM}


class Moment(NamedTuple):
    """When and how a run is ended."""

    way: str
    by: str
    """'change', 'names', 'written' or 'clock'"""
    share: float
    """of what an undisturbed run does"""


class Way(NamedTuple):
    """How far a run came: what the moments of the others are shares of."""

    changes: int
    names: int
    written: int
    """[bytes]"""
    seconds: float
    largest: int
    """[bytes] of the largest file"""


class Ended(NamedTuple):
    """What is left of a run beside its files."""

    status: int
    """negative: the number of the signal that ended it"""
    told: str
    left: list[int]
    """processes that went on"""
    way: Way


Command = tuple[str, ...]
_KEPT: list[subprocess.Popen[bytes]] = []
"""so that nobody but `_status` asks for their exit status"""


def run(
    command: Command, folder: Path, moment: Moment | None, whole: Way | None, *, forked: bool
) -> Ended:
    """Run a command in a folder, and end it where that is asked.

    Args:
        command: Arguments of `agv`.
        folder: Where it runs; what it writes there is watched.
        moment: When to end it; None: never.
        whole: How far an undisturbed run comes.
        forked: Whether it is a fork of this process, which has imported all; only then changes
            of files are counted.

    """
    log = folder.with_name('log')
    log.mkdir(exist_ok=True)
    limit = at = None
    if whole is None:
        at = sys.maxsize, 0  # it only counts
    elif moment is not None:
        if moment.way == FULL:
            limit = int(moment.share * whole.largest)
        elif moment.by == 'change':
            at = int(moment.share * whole.changes), NUMBERS[moment.way]
    begun, before = time.monotonic(), _seen(folder)
    pid = (_fork if forked else _spawn)(command, folder, log, limit, at)
    waiting = moment if limit is None and at is None else None
    while (status := _status(pid)) is None:
        passed = time.monotonic() - begun
        if waiting is not None and whole is not None:
            names, size, _ = _seen(folder)
            done = {'names': names - before[0], 'written': size - before[1], 'clock': passed}
            of = {'names': whole.names, 'written': whole.written, 'clock': whole.seconds}
            due = done[waiting.by] >= waiting.share * of[waiting.by]
            if due and _strike(pid, waiting, folder):
                waiting = None
        if passed > LONGEST:
            os.killpg(pid, signal.SIGKILL)
        time.sleep(PERIOD if waiting is not None else IDLE)
    seconds = time.monotonic() - begun
    left = _left(pid, folder)
    names, size, largest = _seen(folder)
    counted = (log / 'changes').read_text() if (log / 'changes').exists() else '0'
    way = Way(int(counted), names - before[0], size - before[1], seconds, largest)
    told = (log / 'told').read_text(errors='replace')
    if seconds > LONGEST:
        told += f'\nTraceback: none, but it was ended after {LONGEST} s'
    return Ended(status, told, left, way)


def _strike(pid: int, moment: Moment, folder: Path) -> bool:
    """Send a signal, where that can be; return whether it was sent.

    Ctrl-C goes to all processes of a terminal, the others to the first alone, or to a worker that
    is in the middle of its task.
    """
    if moment.way == WORKER:
        writing = holders(folder)
        for worker in writing[:1]:
            os.kill(worker, signal.SIGKILL)
        return bool(writing)
    if moment.way == INTERRUPT:
        os.killpg(pid, signal.SIGINT)
    else:
        os.kill(pid, NUMBERS[moment.way])
    return True


def holders(folder: Path) -> list[int]:
    """Return the processes that hold a hidden folder in a folder: they are writing a result."""
    found = []
    for path in Path('/proc').glob('[0-9]*/fd'):
        with suppress(OSError):
            for descriptor in path.iterdir():
                with suppress(OSError):
                    target = os.readlink(descriptor)  # noqa: PTH115 - it is no path of ours
                    if target.startswith(f'{folder}/') and '.unfinished-' in target:
                        found.append(int(path.parent.name))
    return sorted(set(found))


def _status(pid: int) -> int | None:
    """Return the exit status of a process, None while it runs."""
    found, status = os.waitpid(pid, os.WNOHANG)
    return os.waitstatus_to_exitcode(status) if found else None


def _left(session: int, folder: Path) -> list[int]:
    """Return the processes that still go on long after the first of their session has ended."""
    end = time.monotonic() + PATIENCE
    while (left := members(session) + holders(folder)) and time.monotonic() < end:
        time.sleep(0.01)
    for pid in left:
        os.kill(pid, signal.SIGKILL)
    return left


def members(session: int) -> list[int]:
    """Return the living processes of a session."""
    found = []
    for path in Path('/proc').glob('[0-9]*/stat'):
        try:
            state, _, _, sid = path.read_text().rpartition(') ')[2].split()[:4]
        except OSError:
            continue
        if int(sid) == session and state != 'Z':
            found.append(int(path.parent.name))
    return found


def _seen(folder: Path) -> tuple[int, int, int]:
    """Return how many files lie below a folder, their bytes, and those of the largest."""
    sizes = []
    for place, _, files in os.walk(folder):
        for file in files:
            with suppress(OSError):  # gone meanwhile
                sizes.append(os.lstat(os.path.join(place, file)).st_size)  # noqa: PTH118 - fast
    return len(sizes), sum(sizes), max(sizes, default=0)


def _spawn(command: Command, folder: Path, log: Path, limit: int | None, _: Any) -> int:
    """Start a real `agv`."""
    (log / 'changes').unlink(missing_ok=True)

    def confine() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    with (log / 'told').open('wb') as told:
        process = subprocess.Popen(  # noqa: S603 - our own command
            [sys.executable, '-m', 'agv_motion.cli.main', *command],
            cwd=folder, stdin=subprocess.DEVNULL, stdout=told, stderr=told, start_new_session=True,
            preexec_fn=confine if limit is not None else None,  # noqa: PLW1509 - no thread runs
        )  # fmt: skip
    _KEPT.append(process)
    return process.pid


@cache
def _imported() -> Callable[[], None]:
    """Import what any command does, so that no fork has to, and return the command."""
    for module in walk_packages(agv_motion.cli.__path__, 'agv_motion.cli.'):
        importlib.import_module(module.name)
    for name in ('mcap.reader', 'rosbags.rosbag2', 'matplotlib.pyplot', 'rich.progress'):
        importlib.import_module(name)
    main: Callable[[], None] = importlib.import_module('agv_motion.cli.main').main
    return main


def _fork(
    command: Command, folder: Path, log: Path, limit: int | None, at: tuple[int, int] | None
) -> int:
    """Start a fork of this process that goes on as `agv`."""
    main = _imported()
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    pid = os.fork()
    if pid:
        return pid
    os.setsid()
    told = os.open(log / 'told', os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    for stream in (1, 2):
        os.dup2(told, stream)
    os.chdir(folder)
    sys.argv = ['agv', *command]
    if limit is not None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
    return _go_on_as(main, log, at)


def _go_on_as(main: Callable[[], None], log: Path, at: tuple[int, int] | None) -> NoReturn:
    status = 1
    try:
        changes = Changes(at) if at is not None else None
        try:
            main()
            status = 0
        except SystemExit as end:
            status = int(end.code or 0)
        sys.setprofile(None)
        (log / 'changes').write_text(str(changes.count if changes is not None else 0))
    except BaseException:  # noqa: BLE001 - as Python ends a program
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)


def _is_of_a_file(owner: object) -> bool:
    """Return whether a function that changes things changes a file: no text, no terminal."""
    if isinstance(owner, IN_MEMORY):
        return False
    if isinstance(owner, io.IOBase) and not owner.closed:
        return owner.writable() and owner.fileno() > 2
    return True


class Changes:
    """Counts what changes files, and sends a signal to its own process at a number of it."""

    def __init__(self, at: tuple[int, int]) -> None:
        """Begin; ``at`` is the number, and the signal."""
        self.count = 0
        self._at = at
        threading.setprofile(self._see)
        sys.setprofile(self._see)

    def _see(self, _: Any, event: str, argument: Any) -> None:
        if event[:2] != 'c_' or getattr(argument, '__name__', '') not in CHANGES:
            return
        if _is_of_a_file(getattr(argument, '__self__', None)):
            self.count += 1
            if self.count == self._at[0] + 1:
                os.kill(os.getpid(), self._at[1])
