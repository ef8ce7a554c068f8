"""Message types from the text of their definition, as a bag keeps it."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.cdr.idl_text import fields_from_idl
from agv_motion.bag.cdr.interface_parts import SEPARATOR, following, sections
from agv_motion.bag.cdr.primitives import PRIMITIVES
from agv_motion.bag.cdr.unfolded import Member, Struct
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

LONGEST_TEXT = 1 << 20
DEEPEST = 32
MOST_FIELDS = 20_000
"""Of one type with all that it contains: a definition that unfolds further is a trap."""

_FIELD = re.compile(
    r'(?P<type>[A-Za-z][\w/]*)(?:<=\d{1,18})?'
    r'(?P<array>\[(?:<=)?(?P<size>\d{0,18})\])?'
    r'[ \t]+(?P<name>[A-Za-z]\w*)[ \t]*(?P<constant>=)?'
)
_TYPE = re.compile(r'\w+(?:/\w+)+')
_NAME = re.compile(r'(?:MSG|SRV|ACTION):[ \t]*([\w/]+)[ \t]*')


class Field(NamedTuple):
    """A field as it is declared."""

    name: str
    type: str
    """a primitive, or PACKAGE/NAME"""
    array: bool = False
    size: int | None = None
    """number of elements of a fixed array; None of any other"""


def unfold(message_type: str, definition: str, encoding: str) -> Struct:
    """Return a message type with everything that it contains.

    Args:
        message_type: Such as ``geometry_msgs/msg/Twist``.
        definition: Text of the type, and of all that it uses.
        encoding: ``ros2msg`` or ``ros2idl``.

    Raises:
        ConfigurationError: The text cannot be understood, lacks a type, or is a trap.

    """
    types = declared(message_type, definition, encoding)
    return _Unfolding(types, message_type).struct(short(message_type), ())


def declared(message_type: str, definition: str, encoding: str) -> dict[str, list[Field]]:
    """Return the fields of a type and of all that it uses, by their names as PACKAGE/NAME.

    Arguments and errors as of :func:`unfold`, which finds what is missing.
    """
    if len(definition) > LONGEST_TEXT:
        msg = f'definition of {message_type}: {len(definition)} characters, at most {LONGEST_TEXT}'
        raise ConfigurationError(msg)
    if not _TYPE.fullmatch(message_type):  # rosbags makes code of names
        msg = f'type {message_type!r:.80}: expected a name such as geometry_msgs/msg/Twist'
        raise ConfigurationError(msg)
    root = short(message_type)
    if encoding == 'ros2msg':
        types = _from_msg(root, definition)
    elif encoding == 'ros2idl':
        found = fields_from_idl(message_type, definition)
        types = {
            short(name): [Field(n, short(t) if '/' in t else t, a, s) for n, t, a, s in fields]
            for name, fields in found.items()
        }
    elif not definition:
        msg = f'the bag has no definition of {message_type}'
        raise ConfigurationError(msg)
    else:
        msg = f'definition of {message_type}: encoding {encoding!r}, expected ros2msg or ros2idl'
        raise ConfigurationError(msg)
    return _used(root, types)


def _used(root: str, types: dict[str, list[Field]]) -> dict[str, list[Field]]:
    """Return those types that ``root`` uses, and those that follow from them."""
    used: dict[str, list[Field]] = {}
    waiting = [root]
    while waiting:
        name = waiting.pop()
        if name in used:
            continue
        if name not in types and (text := following(name)):
            types = types | _from_msg(name, text)
        if name in types:
            used[name] = types[name]
            waiting += [field.type for field in types[name] if '/' in field.type]
    return used


def short(name: str) -> str:
    """Return PACKAGE/NAME of PACKAGE/msg/NAME."""
    package, _, rest = name.partition('/')
    return f'{package}/{rest.rpartition("/")[2]}'


def _from_msg(root: str, text: str) -> dict[str, list[Field]]:
    """Return the fields of every type in a definition; the first one has the name ``root``."""
    types: dict[str, list[Field]] = {}
    for name, lines in _parts(root, text):
        for part, content in sections(name, lines):
            types[part] = _fields(root, part.partition('/')[0], content)
    return types


def _parts(root: str, text: str) -> Iterator[tuple[str, list[str]]]:
    """Yield name and lines of each file in a definition."""
    name, lines, named = root, [''], True
    for line in text.splitlines():
        content = line.strip()
        if content.startswith(SEPARATOR[:3]) and not content.strip('='):
            named = False
        elif not named and (match := _NAME.fullmatch(content)):
            if any(lines):
                yield name, lines
            name, lines, named = short(match[1]), [''], True
        else:
            lines.append(content)
    yield name, lines


def _fields(root: str, package: str, lines: Sequence[str]) -> list[Field]:
    """Return the fields that the lines of a file declare."""
    fields = []
    for number, content in enumerate(lines):
        if content and content[0] not in '#@':
            match = _FIELD.match(content)
            if not match:
                msg = f'definition of {root}, line {number}: {content[:80]!r} is no field'
                raise ConfigurationError(msg)
            if not match['constant']:
                fields.append(_field(match, package))
    return fields


def _field(match: re.Match[str], package: str) -> Field:
    kind = match['type']
    if '/' in kind:
        kind = short(kind)
    elif kind not in PRIMITIVES and kind not in ('string', 'wstring'):
        kind = f'{package}/{kind}'
    bounded = '<=' in (match['array'] or '')
    size = int(match['size']) if match['size'] and not bounded else None
    return Field(match['name'], kind, bool(match['array']), size)


NOTHING = 'structure_needs_at_least_one_member'
_NOTHING = Member(NOTHING, 'uint8', array=False, size=None)
"""An empty struct has one byte, as in C; ROS gives it this name."""


class _Unfolding:
    """Unfolds types, and stops at a trap."""

    def __init__(self, types: Mapping[str, Sequence[Field]], wanted: str) -> None:
        self._types, self._wanted = types, wanted
        self._fields = 0

    def struct(self, name: str, inside: tuple[str, ...]) -> Struct:
        """Return the type ``name``, which stands inside of others."""
        fields = self._types.get(name)
        self._fields += len(fields or ()) + 1
        if name in inside:
            trap = f'{name} contains itself, by way of {" and ".join(inside)}'
        elif len(inside) > DEEPEST:
            trap = f'types are nested more than {DEEPEST} deep'
        elif fields is None:
            trap = f'{name} is not defined'
        elif self._fields > MOST_FIELDS:
            trap = f'it unfolds to more than {MOST_FIELDS} fields'
        elif len({field.name for field in fields}) < len(fields):
            trap = f'{name} has two fields of the same name'
        else:
            return self._members(name, fields, (*inside, name))
        msg = f'definition of {self._wanted}: {trap}'
        raise ConfigurationError(msg)

    def _members(self, name: str, fields: Sequence[Field], inside: tuple[str, ...]) -> Struct:
        members = [Member(f.name, self._type(f.type, inside), f.array, f.size) for f in fields]
        return Struct(name, members or [_NOTHING])

    def _type(self, kind: str, inside: tuple[str, ...]) -> str | Struct:
        return self.struct(kind, inside) if '/' in kind else kind
