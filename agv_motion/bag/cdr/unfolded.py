"""A message type, unfolded: a tree whose leaves are primitives."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence


class Member(NamedTuple):
    """A field whose type is known down to the primitives."""

    name: str
    type: str | Struct
    array: bool
    size: int | None


class Struct(NamedTuple):
    """A message type, unfolded."""

    name: str
    members: Sequence[Member]
