"""Keys as they are pressed, where there is a terminal."""

from __future__ import annotations

import os
import select
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

ARROWS = {'\x1b[A': 'up', '\x1b[B': 'down', '\x1b[C': 'right', '\x1b[D': 'left'}


def split(text: str) -> list[str]:
    """Return the keys in what a terminal sent; arrows by their names."""
    keys = []
    while text:
        key = text[:3] if text[:3] in ARROWS else text[0]
        keys.append(ARROWS.get(key, key))
        text = text[len(key) :]
    return keys


@contextmanager
def keyboard(*, enabled: bool) -> Iterator[Callable[[], list[str]]]:
    """Yield a function that returns the keys pressed since the last call; never waits."""
    if not (enabled and sys.stdin.isatty()):
        yield list
        return
    import termios
    import tty

    descriptor = sys.stdin.fileno()
    before = termios.tcgetattr(descriptor)
    tty.setcbreak(descriptor)

    def pressed() -> list[str]:
        if not select.select([descriptor], [], [], 0.0)[0]:
            return []
        return split(os.read(descriptor, 1024).decode(errors='ignore'))

    try:
        yield pressed
    finally:
        termios.tcsetattr(descriptor, termios.TCSADRAIN, before)
