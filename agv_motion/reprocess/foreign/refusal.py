"""What a node must not do if its results are to be the same again, and how it is told.

Installed once, in a process that does nothing else, before the node is imported. What is called by
the node itself is refused; the same, called by rclpy or by this package, goes on.
"""

from __future__ import annotations

import functools
import os
import sys
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import FrameType

CLOCK = 'use self.get_clock().now(), which tells the time of the recording'
SEED = 'give it a seed, as numpy.random.default_rng(1)'
KEEPS = 'a node can be reprocessed that keeps to publishers, subscriptions, timers and parameters'
_refused: list[str] = []
_packages: set[str] = set()
"""top-level packages of the nodes"""


class Refusal(BaseException):
    """A node does what cannot be reprocessed; no `except Exception` of its own may swallow it."""


def refuse(what: str, remedy: str) -> None:
    """End the run of a node.

    Raises:
        Refusal: Always.

    """
    text = f'{what}{_place()}: {remedy}'
    _refused.append(text)
    raise Refusal(text)


@contextmanager
def told(name: str) -> Iterator[None]:
    """Turn what is refused in the block into an error that names the node.

    Raises:
        ConfigurationError: Something was refused, even where the node went on.

    """
    _refused.clear()
    with suppress(Refusal):
        yield
    if _refused:
        msg = f'{name} cannot be reprocessed: it {_refused[0]}'
        raise ConfigurationError(msg)


def watch(package: str) -> None:
    """Refuse what a package does from now on that would not be the same again."""
    if not _packages:
        _install()
    _packages.add(package)


def _install() -> None:
    import random
    import socket
    import subprocess
    import threading
    import time
    import uuid

    import numpy as np
    from rclpy import action, clock, executors

    for name in ('time', 'time_ns', 'monotonic', 'monotonic_ns', 'perf_counter', 'perf_counter_ns'):
        _guard(time, name, 'looks at the clock on the wall', CLOCK)
    for name in ('localtime', 'gmtime', 'ctime'):
        _guard(time, name, 'looks at the clock on the wall', CLOCK, free=1)
    _guard(time, 'sleep', 'sleeps', 'use a timer, self.create_timer(seconds, callback)')
    _guard(uuid, 'uuid1', 'makes what is never the same', 'count instead')
    _guard(uuid, 'uuid4', 'makes what is never the same', 'count instead')
    for holder in (random.Random, np.random.default_rng):
        owner = random if holder is random.Random else np.random
        _guard(owner, holder.__name__, 'draws random numbers without a seed', SEED, free=1)
    _guard(random, 'SystemRandom', 'draws random numbers without a seed', SEED)
    _guard(os, 'urandom', 'makes what is never the same', 'count instead')
    for name in ('run', 'call', 'check_call', 'check_output'):
        _guard(subprocess, name, 'starts a process', KEEPS)
    for name in ('system', 'popen'):
        _guard(os, name, 'starts a process', KEEPS)
    _always(subprocess.Popen, '__init__', 'starts a process', KEEPS)
    _always(socket.socket, '__init__', 'opens a socket', KEEPS)
    _guard(socket, 'create_connection', 'opens a socket', KEEPS)
    _always(threading.Thread, 'start', 'starts a thread', 'use timers', deep=True)
    _always(action.ActionClient, '__init__', 'has a client of an action', KEEPS)
    _always(action.ActionServer, '__init__', 'offers an action', KEEPS)
    for kind in (clock.Clock, clock.ROSClock):
        for name in ('sleep_until', 'sleep_for'):
            _always(kind, name, 'sleeps', 'use a timer, self.create_timer(seconds, callback)')
    _other_clocks(clock)
    _spinning(executors)


def _other_clocks(clock: Any) -> None:
    """Refuse the time of clocks that are not that of the node."""
    now = clock.Clock.now

    @functools.wraps(now)
    def guarded(self: Any) -> Any:
        if not getattr(self, 'is_recorded', False) and _caller() in _packages:
            refuse('looks at a clock of its own', CLOCK)
        return now(self)

    clock.Clock.now = guarded


def _spinning(executors: Any) -> None:
    import rclpy

    remedy = 'let the constructor return; callbacks come by themselves'
    for name in ('spin', 'spin_once', 'spin_until_future_complete'):
        _always(rclpy, name, 'spins', remedy)
        _always(executors.Executor, name, 'spins', remedy)


def _guard(owner: Any, name: str, what: str, remedy: str, free: int = 0) -> None:
    """Refuse a function where a node calls it, but with ``free`` arguments if that is given."""
    original = getattr(owner, name)
    if isinstance(original, type):
        kind: Any = original

        class Guarded(kind):
            def __new__(cls, *args: Any, **options: Any) -> Any:
                if _caller() in _packages and len(args) + len(options) < max(free, 1):
                    refuse(f'{what}, {owner.__name__}.{name}()', remedy)
                return super().__new__(cls, *args, **options)

        Guarded.__name__ = name
        setattr(owner, name, Guarded)
        return

    @functools.wraps(original)
    def guarded(*args: Any, **options: Any) -> Any:
        if _caller() in _packages and not (free and len(args) + len(options) >= free):
            refuse(f'{what}, {owner.__name__}.{name}()', remedy)
        return original(*args, **options)

    setattr(owner, name, guarded)


def _always(owner: Any, name: str, what: str, remedy: str, *, deep: bool = False) -> None:
    """Refuse a method where a node calls it, itself or ``deep`` through others."""
    original = getattr(owner, name)

    @functools.wraps(original)
    def guarded(*args: Any, **options: Any) -> Any:
        if _caller() in _packages or (deep and _frame() is not None):
            refuse(what, remedy)
        return original(*args, **options)

    setattr(owner, name, guarded)


def _caller() -> str:
    """Return the top-level package of who called the function that asks."""
    return str(sys._getframe(2).f_globals.get('__name__', '')).partition('.')[0]  # noqa: SLF001


def _frame() -> FrameType | None:
    """Return the innermost frame of a node."""
    frame: FrameType | None = sys._getframe(1)  # noqa: SLF001
    while frame is not None:
        if str(frame.f_globals.get('__name__', '')).partition('.')[0] in _packages:
            return frame
        frame = frame.f_back
    return None


def _place() -> str:
    frame = _frame()
    return (
        '' if frame is None else f' in {Path(frame.f_code.co_filename).name}, line {frame.f_lineno}'
    )


def refusing(what: str, remedy: str = KEEPS) -> Callable[..., Any]:
    """Return a method that refuses."""

    def method(_self: Any, *_args: Any, **_options: Any) -> None:
        refuse(what, remedy)

    return method
