"""Fields of message types that a bag defines in IDL (``ros2idl``), parsed by rosbags."""

from __future__ import annotations

from typing import Any

from rosbags.interfaces import Nodetype
from rosbags.typesys import TypesysError, get_types_from_idl

from agv_motion.errors import ConfigurationError

LONGEST_IDL = 1 << 17
"""Characters; the largest of ROS has a tenth of it, and the parser is slow."""


def fields_from_idl(
    message_type: str, text: str
) -> dict[str, list[tuple[str, str, bool, int | None]]]:
    """Return name, type, whether it is an array, and its fixed size, of each field of each type.

    Raises:
        ConfigurationError: The text cannot be understood.

    """
    if len(text) > LONGEST_IDL:
        msg = f'definition of {message_type}: {len(text)} characters of IDL, at most {LONGEST_IDL}'
        raise ConfigurationError(msg)
    try:
        types = get_types_from_idl(text)
    except (TypesysError, ValueError, KeyError, TypeError, AssertionError, RecursionError) as error:
        msg = f'definition of {message_type}: its IDL cannot be understood ({str(error)[:200]})'
        raise ConfigurationError(msg) from error
    return {name: [_field(*field) for field in fields] for name, (_, fields) in types.items()}


def _field(name: str, described: Any) -> tuple[str, str, bool, int | None]:
    kind, content = described
    if kind == Nodetype.NAME:
        return name, content, False, None
    if kind == Nodetype.BASE:
        return name, content[0], False, None
    inner, size = content
    _, base, _, _ = _field(name, inner)
    return name, base, True, size if kind == Nodetype.ARRAY else None
