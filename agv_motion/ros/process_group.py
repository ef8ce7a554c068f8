"""Several programs as one: what they print with the name of each, and an end for all.

Each is told to end when this process does, however that ends: a robot must not drive on without
whoever started it.
"""

from __future__ import annotations

import ctypes
import os
import selectors
import signal
import subprocess
import time
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

RESPAWN_DELAY = 2.0
"""[s] after which a program that ended is started again"""

LAST_WORD, LONGEST = 10.0, 5.0
"""[s] that programs have to end by themselves, and again once they are told more firmly"""

LOOK = 0.1
"""[s] between two looks at whether all still run"""

DEATH_SIGNAL = 1
"""PR_SET_PDEATHSIG of Linux: the signal that a process is sent when its parent has ended"""


def _end_with_parent() -> None:
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # a shell's background job inherits deafness to it
    ctypes.CDLL(None).prctl(DEATH_SIGNAL, signal.SIGINT)


class _Running(NamedTuple):
    process: subprocess.Popen[bytes]
    rest: bytearray


class ProcessGroup:
    """Runs programs until it is told to stop."""

    def __init__(
        self, commands: Mapping[str, Sequence[str]], show: Callable[[str], None], *, respawn: bool
    ) -> None:
        """Start nothing yet.

        Args:
            commands: Words of each program, by its name.
            show: Called with each line, the name before it.
            respawn: Whether one that ended by itself is started again.

        """
        self._commands, self._show, self._respawn = commands, show, respawn
        self._running: dict[str, _Running] = {}
        self._due: dict[str, float] = {}
        self._selector = selectors.DefaultSelector()
        self.failed = False
        """Whether one ended by itself and was not started again, or had to be killed"""

    def run(self, until: Callable[[], bool]) -> None:
        """Run all until ``until()``, or until none is left; then end all."""
        try:
            for name in self._commands:
                self._start(name)
            while (self._running or self._due) and not until():
                self._read(LOOK)
                self._look()
        finally:
            self._end()

    def _start(self, name: str) -> None:
        process = subprocess.Popen(  # noqa: S603 - our own programs
            self._commands[name],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env={**os.environ, 'PYTHONUNBUFFERED': '1'},
            start_new_session=True,  # Ctrl-C comes to us, and from us to all
            preexec_fn=_end_with_parent,  # noqa: PLW1509 - there is one thread here
        )
        assert process.stdout is not None
        os.set_blocking(process.stdout.fileno(), False)
        self._running[name] = _Running(process, bytearray())
        self._selector.register(process.stdout, selectors.EVENT_READ, name)

    def _read(self, seconds: float) -> None:
        """Show what has been printed; wait no longer than ``seconds`` for more."""
        for key, _ in self._selector.select(seconds):
            self._take(key.data)

    def _take(self, name: str) -> bool:
        """Show what one program has printed; return False where there is no more to come."""
        process, rest = self._running[name]
        assert process.stdout is not None
        data = process.stdout.read(1 << 16)
        if data:
            *lines, last = (bytes(rest) + data).split(b'\n')
            rest[:] = last
            for line in lines:
                self._say(name, line.decode(errors='backslashreplace'))
        return bool(data)

    def _look(self) -> None:
        """Tell of those that have ended, and start again those whose time has come."""
        for name in [n for n, one in self._running.items() if one.process.poll() is not None]:
            status = self._reap(name)
            if self._respawn:
                self._due[name] = time.monotonic() + RESPAWN_DELAY
                self._say(name, f'{_ended(status)}: starting it again in {RESPAWN_DELAY:g} s')
            else:
                self.failed = True
                others = ', the others go on' if self._running else ''
                self._say(name, f'{_ended(status)}{others}')
        for name in [n for n, due in self._due.items() if time.monotonic() >= due]:
            del self._due[name]
            self._start(name)

    def _reap(self, name: str) -> int:
        """Show the last words of a program that has ended, and forget it; return its status."""
        while self._take(name):
            pass
        process, rest = self._running.pop(name)
        assert process.stdout is not None
        if rest:
            self._say(name, rest.decode(errors='backslashreplace'))
        self._selector.unregister(process.stdout)
        process.stdout.close()
        return process.wait()

    def _end(self) -> None:
        """Let all end: they are asked, told, and killed at last."""
        for number, patience in (
            (signal.SIGINT, LAST_WORD), (signal.SIGTERM, LONGEST), (signal.SIGKILL, LONGEST),
        ):  # fmt: skip
            for name, one in self._running.items():
                if number is signal.SIGKILL:
                    self.failed = True
                    self._say(name, 'does not end: killed, so it sent no zero')
                one.process.send_signal(number)
            end = time.monotonic() + patience
            while self._running and time.monotonic() < end:
                self._read(LOOK)
                for name in [n for n, o in self._running.items() if o.process.poll() is not None]:
                    status = self._reap(name)
                    if status:
                        self.failed = True
                        self._say(name, _ended(status))
        self._selector.close()

    def _say(self, name: str, text: str) -> None:
        self._show(f'[{name}] {text}')


def _ended(status: int) -> str:
    if status < 0:
        return f'ended by signal {-status} ({signal.Signals(-status).name})'
    return f'ended with exit status {status}'
