"""What the commands print, with the text of others in it made visible."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from rich.file_proxy import FileProxy

from agv_motion.visible import visible

if TYPE_CHECKING:
    from typing import TextIO


class VisibleStream(FileProxy):
    """A stream that makes text `visible`.

    To `rich` it is a proxy of a file: its consoles, which draw, go past it, and it is not replaced
    by another while they do.
    """

    def __init__(self, stream: TextIO) -> None:
        """Keep where text goes."""
        super().__init__(None, stream)  # type: ignore[arg-type] # the console of `write` there
        self._stream = stream

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """Of the stream."""
        return self._stream.encoding

    @property
    def errors(self) -> str | None:  # type: ignore[override]
        """What is done with characters that its encoding has not."""
        return self._stream.errors

    def write(self, text: str) -> int:
        """Write text; return its length."""
        self._stream.write(visible(text))
        return len(text)

    def flush(self) -> None:
        """Hand on what was written."""
        self._stream.flush()


def guard() -> None:
    """Make visible whatever this process prints from now on."""
    for name in ('stdout', 'stderr'):
        stream = getattr(sys, name)
        if stream is not None and not isinstance(stream, VisibleStream):
            setattr(sys, name, VisibleStream(stream))
