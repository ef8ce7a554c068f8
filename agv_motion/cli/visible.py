r"""Text of others made visible: what a terminal would obey is shown, not done.

Names, texts and notes come out of bags and graphs that anybody may have made. ESC, other control
characters and marks that turn the direction of writing are written as ``\x1b`` or ``\u202e``,
wherever the text goes: :func:`guard` stands before whatever is printed, and
`agv_motion.cli.terminal` before what is drawn, whose own colours stay.
"""

from __future__ import annotations

import re
import sys
from typing import TYPE_CHECKING

from rich.file_proxy import FileProxy

if TYPE_CHECKING:
    from typing import TextIO

_OBEYED = re.compile(
    '[\0-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]|\r(?!\n)'
)
_WITHIN_LINE = re.compile('[\t\n\r]')


def visible(text: str) -> str:
    """Return text in which a terminal finds nothing to obey but line feeds and tabs.

    What follows ASCII is written as in JSON, which thereby stays JSON.
    """
    return _OBEYED.sub(_escaped, text)


def in_line(text: object) -> str:
    """Return what is to stand within a line, such as a name: line feeds and tabs escaped, too."""
    return _WITHIN_LINE.sub(_escaped, str(text))


def indented(text: object) -> str:
    """Return text of several lines of which only the first can pass for a line of ours."""
    return str(text).replace('\n', '\n    ')


def _escaped(found: re.Match[str]) -> str:
    code = ord(found[0])
    return f'\\x{code:02x}' if code < ord(' ') else f'\\u{code:04x}'


class VisibleStream(FileProxy):
    """A stream that makes text :func:`visible`.

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
