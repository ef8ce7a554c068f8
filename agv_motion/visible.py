r"""Text of others made visible: what a terminal would obey is shown, not done.

Names, texts and notes come out of bags, graphs and wires that anybody may have written. ESC, other
control characters and marks that turn the direction of writing are written as ``\x1b`` or
``\u202e``, wherever the text goes: `agv_motion.cli.visible_stream` stands before whatever is
printed, `agv_motion.cli.terminal` before what is drawn, whose own colours stay, and
`agv_motion.ros.visible_logger` before what a node logs.
"""

from __future__ import annotations

import re

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
