"""One JSON object of a logger or gateway: the members that are named, and nothing guessed.

``{"time": "2013-06-10T12:30:00Z", "probe_1": 0.75, "air": {"vpd": 0.8}}``: a member within another
is ``air.vpd``, an element of a list ``probes.0``.
"""

from __future__ import annotations

import json
from math import nan
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.errors import SignalError
from agv_motion.probe.sources.logger_line import number_of

if TYPE_CHECKING:
    from collections.abc import Sequence


class JsonLine(NamedTuple):
    """What one object tells."""

    time: str
    """word of its time; empty where none is asked for"""
    values: tuple[float, ...]
    """in the unit of the logger; NaN where there is none"""


def read_json(text: str, keys: Sequence[str], time_key: str) -> JsonLine:
    """Return what an object tells.

    Args:
        text: The object.
        keys: Members that are the values, in their order.
        time_key: Member that is the time; empty: none is.

    Raises:
        SignalError: It is no object, or has no such member, or one twice.

    """
    try:
        # numbers stay the words that they are: each reader has its own rule for them
        told = json.loads(text, parse_int=str, parse_float=str, object_pairs_hook=_unique)
    except (ValueError, RecursionError) as error:
        msg = f'it is no JSON object ({error})'
        raise SignalError(msg) from error
    if not isinstance(told, dict):
        msg = 'it is JSON, but no object {...}'
        raise SignalError(msg)
    time = _member(told, time_key) if time_key else ''
    if not isinstance(time, str):
        msg = f"its member '{time_key}' is no time: {time!r:.40}"
        raise SignalError(msg)
    return JsonLine(time, tuple(_number(_member(told, key)) for key in keys))


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    members = dict(pairs)
    if len(members) < len(pairs):
        msg = 'a member stands in it twice'
        raise ValueError(msg)
    return members


def _member(told: Any, key: str) -> Any:
    """Return a member by its name, or by those of the members round it with points between."""
    if isinstance(told, dict) and key in told:
        return told[key]
    found = told
    for part in key.split('.'):
        if isinstance(found, dict) and part in found:
            found = found[part]
        elif isinstance(found, list) and part.isdecimal() and int(part) < len(found):
            found = found[int(part)]
        else:
            msg = f"it has no member '{key}', only {', '.join(told)}: give json_keys and json_time"
            raise SignalError(msg)
    return found


def _number(value: Any) -> float:
    return number_of(value) if isinstance(value, str) else nan
