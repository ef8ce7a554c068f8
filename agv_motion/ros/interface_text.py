"""Interfaces as `ros2 interface` shows them: which are installed, and what each consists of."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.cdr.definitions import PRIMITIVES, interface_file, search_path
from agv_motion.errors import ConfigurationError
from agv_motion.ros.suggestion import meant

if TYPE_CHECKING:
    from collections.abc import Iterator

KINDS = {'msg': 'Messages', 'srv': 'Services', 'action': 'Actions'}
"""Folder of each kind, and how a list calls it"""

_UNIT = re.compile(r'\s*\[[^,\]]+\]')
_FIELD = re.compile(r'([A-Za-z][\w/]*)(?:<=\d+)?(?:\[[^\]]*\])?\s+[A-Za-z][^=]*$')


def installed(kind: str) -> list[str]:
    """Return the names of all interfaces of a kind (msg, srv, action), in order of packages."""
    found: dict[str, set[str]] = {}
    for prefix in search_path():
        for index in (prefix / 'share/ament_index/resource_index/rosidl_interfaces').glob('*'):
            if index.name not in found:
                files = index.read_text(encoding='utf-8').split()
                names = (one.rpartition('.')[0] for one in files if one.startswith(f'{kind}/'))
                found[index.name] = {name for name in names if '_' not in name}
    return [f'{package}/{name}' for package in sorted(found) for name in sorted(found[package])]


def lines(name: str, *, comments: bool = True, nested_comments: bool = False) -> Iterator[str]:
    """Yield the lines of an interface, those of the types that it uses indented below them.

    Args:
        name: Such as ``std_msgs/msg/String``.
        comments: Whether its comments and empty lines are shown.
        nested_comments: Whether those of the types that it uses are.

    Raises:
        ConfigurationError: It is not installed; close names are given.

    """
    package = name.partition('/')[0]
    for text in _file(name).splitlines():
        line = _Line.of(text.rstrip())
        shown = line.text if comments else line.bare
        if shown is not None:
            yield shown
        if line.type:
            full = line.type if '/' in line.type else f'{package}/{line.type}'
            below = full if full.count('/') > 1 else full.replace('/', '/msg/')
            for one in lines(below, comments=nested_comments, nested_comments=nested_comments):
                yield f'\t{one}' if one else ''


class _Line(NamedTuple):
    text: str
    bare: str | None
    """without its comment, as `ros2 interface` leaves it; None if nothing is left"""
    type: str
    """of the field, where that is an interface of its own"""

    @classmethod
    def of(cls, text: str) -> _Line:
        plain = text.replace('\t', ' ')
        code, mark, _ = plain.partition('#')
        comment = _UNIT.sub('', plain[len(code) :].lstrip('#')).strip() if mark else ''
        if not code.strip():
            whole = plain.startswith('#') and bool(comment)
            return cls(text, None if whole or not text else text, '')
        bare = text
        if comment:  # the genuine tool cuts before its words, and leaves the mark
            bare = text[: max(text.find(comment) - 1, len(code) + 1)].strip()
        field = _FIELD.match(code.rstrip())
        kind = field[1] if field and field[1] not in PRIMITIVES else ''
        return cls(text, bare, kind)


def _file(name: str) -> str:
    """Return the text of an interface."""
    package, _, rest = name.partition('/')
    kind, _, short = rest.partition('/')
    if not short or '/' in short:
        msg = f"Invalid name '{name}'. Expected three parts separated by '/'{_near(name)}"
        raise ConfigurationError(msg)
    path = interface_file(package, kind, f'{short}.{kind}')
    if path is None:
        msg = f"Could not find the interface '{name}'{_near(name)}"
        raise ConfigurationError(msg)
    return path.read_text(encoding='utf-8')


def _near(name: str) -> str:
    return meant(name, [one for kind in KINDS for one in installed(kind)])
