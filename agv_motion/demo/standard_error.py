"""What nodes log while a live picture is shown: lines of their own above it.

rclpy writes to the descriptor of standard error itself, into the middle of whatever stands there.
So it is given a file instead while the picture is shown, which the picture's owner reads. A pipe
would do, but for who fills it faster than it is read: he is the same process, and would wait for
himself.
"""

from __future__ import annotations

import os
import sys
import tempfile
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

STANDARD_ERROR = 2


@contextmanager
def apart(show: Callable[[str], None]) -> Iterator[Callable[[], None]]:
    """Keep standard error from the terminal; yield what shows what has come by whole lines.

    Args:
        show: Called with whole lines; what comes last is shown at the end, whatever happens.

    """
    rest = b''
    with tempfile.TemporaryFile() as file:
        kept = os.dup(STANDARD_ERROR)
        sys.stderr.flush()
        reader = os.dup(file.fileno())
        read = 0

        def told() -> bytes:
            nonlocal read
            new = os.pread(reader, max(os.fstat(reader).st_size - read, 0), read)
            read += len(new)
            return new

        def show_lines() -> None:
            nonlocal rest
            whole, mark, rest = (rest + told()).rpartition(b'\n')
            if mark:
                show(whole.decode(errors='backslashreplace'))

        os.dup2(file.fileno(), STANDARD_ERROR)
        try:
            yield show_lines
        finally:
            sys.stderr.flush()
            os.dup2(kept, STANDARD_ERROR)
            os.close(kept)
            last = (rest + told()).decode(errors='backslashreplace').rstrip('\n')
            os.close(reader)
            if last:
                show(last)
