"""Signals that end a process: quietly however early they come, and never before the last word.

Three stretches of a process's life: while its imports run nothing is open yet, and a signal ends it
on the spot; from `Stop` on a signal is a request, so that zeros can still be sent; after the last
word a signal is nothing more.
"""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path

SIGNALS = signal.SIGINT, signal.SIGTERM, signal.SIGHUP


def is_program(*names: str) -> bool:
    """Return whether this process is a script of one of these names, or our ``python -m``."""
    started = sys.argv[0] if sys.argv else ''
    if started == '-m':  # as long as the package of the module is imported
        return any(word.startswith('agv_motion.') for word in sys.orig_argv)
    return Path(started).name in names


def end_at_once(status: int = 0) -> None:
    """Let a signal end the process with ``status`` on the spot: as long as nothing is open."""
    for number in _heeded():
        signal.signal(number, lambda *_: os._exit(status))


def interrupt() -> None:
    """Let each signal raise KeyboardInterrupt, as Ctrl-C does in any Python program."""
    for number in _heeded():
        signal.signal(number, signal.default_int_handler)


def end_no_more() -> None:
    """Let signals do nothing: the last word is said, and the interpreter takes itself down."""
    for number in _heeded():
        signal.signal(number, signal.SIG_IGN)


class Stop:
    """Turns true at SIGINT, SIGTERM or SIGHUP; the context lives on, so that a last word is sent.

    A second signal changes nothing: it must not cut that word short.
    """

    def __init__(self) -> None:
        """Take over the signals."""
        self.requested = False
        for number in _heeded():
            signal.signal(number, self._on_signal)

    def _on_signal(self, *_: object) -> None:
        self.requested = True


def _heeded() -> list[signal.Signals]:
    """Return the signals to handle: a process begun by `nohup` is to outlive its terminal."""
    return [
        number
        for number in SIGNALS
        if number != signal.SIGHUP or signal.getsignal(number) is not signal.SIG_IGN
    ]
