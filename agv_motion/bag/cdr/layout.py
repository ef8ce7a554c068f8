"""Where every value of a message lies: a walk through CDR by its type (XCDR version 1).

A number is aligned to its size, counted from behind the four bytes of header; a string has its
length with the final zero before it, a sequence its number of elements. Values of one field in
all elements of the arrays around it are one :class:`Leaf`, in the order of their bytes.
Source: OMG DDS-XTypes 1.3, section 7.4.1.
"""

from __future__ import annotations

from struct import Struct as Form
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.cdr.primitives import PRIMITIVES
from agv_motion.bag.cdr.unfolded import Struct
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.bag.cdr.unfolded import Member
    from agv_motion.bag.mcap.record_parsing import Buffer

    Segment = tuple[int, int, int]

_PADDING = 3
"""[bytes] that some vendors append, to a multiple of four."""
_LENGTHS = {'<': Form('<I').unpack_from, '>': Form('>I').unpack_from}


class Leaf(NamedTuple):
    """The values of one field."""

    number: int
    path: str
    """such as ``poses.position.x``"""
    type: str
    """a primitive, ``string``, or ``length`` of a sequence"""
    dimensions: Sequence[int | None]
    """of the arrays around it, outermost first: a fixed size, or None of a sequence"""
    lengths: Sequence[int]
    """for each None, the leaf that holds the lengths"""


class FieldOffsets:
    """What one walk through a message finds."""

    def __init__(self, data: Buffer, start: int, size: int, order: str, leaves: int) -> None:
        """Stand at the beginning of a message.

        Args:
            data: Buffer that holds the message.
            start: [bytes] where its content begins, behind the header.
            size: [bytes] of its content.
            order: '<' little-endian or '>' big-endian.
            leaves: Their number.

        """
        self._data, self._start, self._unpack = data, start, _LENGTHS[order]
        self.size = size
        self.found: list[list[Segment]] = [[] for _ in range(leaves)]
        """for each leaf: offset from the beginning, number of values and their stride; of a
        string, its offset, length with the final zero, 1; of a length, it, 1 and its offset"""
        self.guards: list[int] = []
        """where the lengths lie: messages that agree in them have the same layout"""

    def length(self, position: int) -> tuple[int, int]:
        """Return a length, and the position behind it.

        Raises:
            ValueError: The message ends before.

        """
        position = (position + 3) & -4
        if position + 4 > self.size:
            msg = f'its {self.size} bytes end before a length at byte {position}'
            raise ValueError(msg)
        self.guards.append(position)
        return self._unpack(self._data, self._start + position)[0], position + 4

    def beyond(self, position: int) -> ValueError:
        """Return the error that something ends behind the end of the message."""
        return ValueError(f'its {self.size} bytes end before a value that ends at byte {position}')


class _Numbers:
    """A number, or an array of numbers."""

    def __init__(self, leaf: int, size: int, count: int = 1) -> None:
        self._leaf, self._size, self._count = leaf, size, count

    def place(self, walk: FieldOffsets, position: int) -> int:
        if self._count:
            position = (position + self._size - 1) & -self._size
            walk.found[self._leaf].append((position, self._count, self._size))
        return position + self._count * self._size


class _NumberSequence:
    """A sequence of numbers."""

    def __init__(self, lengths: int, leaf: int, size: int) -> None:
        self._lengths, self._leaf, self._size = lengths, leaf, size

    def place(self, walk: FieldOffsets, position: int) -> int:
        count, position = walk.length(position)
        walk.found[self._lengths].append((count, 1, position - 4))
        if count:
            position = (position + self._size - 1) & -self._size
            walk.found[self._leaf].append((position, count, self._size))
        return position + count * self._size


class _String:
    """A string."""

    def __init__(self, leaf: int) -> None:
        self._leaf = leaf

    def place(self, walk: FieldOffsets, position: int) -> int:
        size, position = walk.length(position)
        walk.found[self._leaf].append((position, size, 1))
        if position + size > walk.size:
            raise walk.beyond(position + size)
        return position + size


class _Struct:
    """Members one after another."""

    def __init__(self, members: Sequence[Node], leaves: range) -> None:
        self._members, self.leaves = members, leaves
        self.fixed: bool = all(
            isinstance(m, _Numbers) or (isinstance(m, _Struct) and m.fixed) for m in members
        )

    def place(self, walk: FieldOffsets, position: int) -> int:
        for member in self._members:
            position = member.place(walk, position)
        return position


class _Array:
    """A fixed array, or a sequence, of structs or strings."""

    def __init__(self, element: _Struct | _String, size: int | None, lengths: int) -> None:
        self._element, self._size, self._lengths = element, size, lengths

    def place(self, walk: FieldOffsets, position: int) -> int:
        count = self._size
        if count is None:
            count, position = walk.length(position)
            walk.found[self._lengths].append((count, 1, position - 4))
        element = self._element
        if count > 2 and isinstance(element, _Struct) and element.fixed:
            return _repeat(walk, element, position, count)
        for _ in range(count):
            position = element.place(walk, position)
            if position > walk.size:
                raise walk.beyond(position)
        return position


Node = _Numbers | _NumberSequence | _String | _Struct | _Array


def _repeat(walk: FieldOffsets, element: _Struct, position: int, count: int) -> int:
    """Place ``count`` elements of a fixed layout.

    Whatever its beginning, an element ends at the same place modulo its largest alignment. So from
    the second one on all begin alike, and follow each other at the same distance.
    """
    first = element.place(walk, position)
    marks = [len(walk.found[leaf]) for leaf in element.leaves]
    second = element.place(walk, first)
    stride = second - first
    end = second + (count - 2) * stride
    if end > walk.size:
        raise walk.beyond(end)
    for leaf, mark in zip(element.leaves, marks, strict=True):
        segments = walk.found[leaf]
        alike = segments[mark:]
        if len(alike) == 1 and alike[0][1] == 1:
            segments[mark] = (alike[0][0], count - 1, stride)
        else:
            segments.extend(
                (offset + i * stride, number, step)
                for i in range(1, count - 1)
                for offset, number, step in alike
            )
    return end


class Layout(NamedTuple):
    """How to walk through the messages of a type."""

    root: _Struct
    leaves: Sequence[Leaf]

    def walk(self, data: Buffer, start: int, size: int, order: str) -> FieldOffsets:
        """Walk through one message; arguments as of :class:`FieldOffsets`.

        Raises:
            ValueError: It is shorter or longer than its type says.

        """
        walk = FieldOffsets(data, start, size, order, len(self.leaves))
        end = self.root.place(walk, 0)
        if end > size:
            raise walk.beyond(end)
        if size - end > _PADDING:
            msg = f'it has {size} bytes, but its type ends after {end}'
            raise ValueError(msg)
        return walk


def layout(kind: Struct) -> Layout:
    """Return how to walk through the messages of a type.

    Raises:
        ConfigurationError: It has a field of a type that CDR does not fix across vendors.

    """
    leaves: list[Leaf] = []
    return Layout(_struct(kind, '', (), (), leaves), leaves)


def _struct(
    kind: Struct,
    path: str,
    dimensions: tuple[int | None, ...],
    lengths: tuple[int, ...],
    leaves: list[Leaf],
) -> _Struct:
    first = len(leaves)
    nodes = [_member(member, path, dimensions, lengths, leaves) for member in kind.members]
    return _Struct(nodes, range(first, len(leaves)))


def _member(
    member: Member,
    path: str,
    dimensions: tuple[int | None, ...],
    lengths: tuple[int, ...],
    leaves: list[Leaf],
) -> Node:
    """Return the node of a field, and append its leaves."""

    def leaf(kind: str) -> int:
        leaves.append(Leaf(len(leaves), name, kind, dimensions, lengths))
        return len(leaves) - 1

    name = f'{path}.{member.name}' if path else member.name
    counter = -1
    if member.array:
        if member.size is None:
            counter = leaf('length')
            lengths = (*lengths, counter)
        dimensions = (*dimensions, member.size)
    if isinstance(member.type, str) and member.type in PRIMITIVES:
        size = PRIMITIVES[member.type].size
        if member.array and member.size is None:
            return _NumberSequence(counter, leaf(member.type), size)
        return _Numbers(leaf(member.type), size, 1 if member.size is None else member.size)
    element: _Struct | _String
    if isinstance(member.type, Struct):
        element = _struct(member.type, name, dimensions, lengths, leaves)
    elif member.type == 'string':
        element = _String(leaf('string'))
    else:
        msg = (
            f'field {name} is a {member.type}, which every vendor of DDS writes in another way: '
            'messages of this type cannot be read by columns'
        )
        raise ConfigurationError(msg)
    return _Array(element, member.size, counter) if member.array else element
