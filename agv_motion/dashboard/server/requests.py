"""What a browser sends, taken apart strictly: what is not as it should be is named and refused."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, NoReturn

from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from collections.abc import Collection

    from starlette.requests import Request

FARTHEST = 1e5
"""[m] of a place on a map, either way"""


class RequestError(AgvMotionError):
    """A request that is refused, with the status of HTTP for it."""

    def __init__(self, status: int, message: str) -> None:
        """Keep status and message."""
        super().__init__(message)
        self.status = status


async def body_of(request: Request, known: Collection[str]) -> dict[str, Any]:
    """Return the JSON object of a request; an empty body is an empty object.

    Raises:
        RequestError: It is none, or has a key that is not known here.

    """
    text = await request.body()
    kind = request.headers.get('content-type', 'application/json')
    if text and kind.partition(';')[0].strip().lower() != 'application/json':
        raise RequestError(415, f"content-type '{kind[:60]}': send application/json")
    return parsed(text, known)


def parsed(text: bytes | str, known: Collection[str]) -> dict[str, Any]:
    """Return the JSON object in a text.

    Raises:
        RequestError: It is none, or has no JSON number, half a character or an unknown key.

    """
    try:
        told = json.loads(text or b'{}', parse_constant=_no_number)
        json.dumps(told, ensure_ascii=False).encode()  # half a character goes nowhere
    except (ValueError, RecursionError) as error:
        raise RequestError(400, f'no JSON: {error}') from error
    if not isinstance(told, dict):
        raise RequestError(400, f'expected a JSON object, got {type(told).__name__}')
    unknown = sorted(set(told) - set(known))
    if unknown:
        names = ', '.join(known) or 'none'
        raise RequestError(400, f"unknown key '{unknown[0][:60]}'; there are {names}")
    return told


def _no_number(name: str) -> NoReturn:
    msg = f'{name} is no number of JSON'
    raise ValueError(msg)


def number(
    told: dict[str, Any], key: str, least: float = -FARTHEST, most: float = FARTHEST,
    default: float | None = None,
) -> float:  # fmt: skip
    """Return a finite number within limits.

    Raises:
        RequestError: It is missing, none, or out of its limits.

    """
    value = told.get(key, default)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise RequestError(422, f'{key} = {str(value)[:60]!r}: expected a number')
    if not least <= value <= most:  # compared as it is: a whole number may be beyond every float
        raise RequestError(422, f'{key} = {str(value)[:40]}: must lie in [{least:g}, {most:g}]')
    return float(value)


def text(
    told: dict[str, Any], key: str, longest: int, default: str | None = None, *, least: int = 0
) -> str:
    """Return a text without characters of control.

    Raises:
        RequestError: It is missing, none, or too long.

    """
    value = told.get(key, default)
    if not isinstance(value, str):
        raise RequestError(422, f'{key} = {str(value)[:60]!r}: expected a text')
    clean = ''.join(c if c.isprintable() else ' ' for c in value).strip()
    if not least <= len(clean) <= longest:
        raise RequestError(422, f'{key} has {len(clean)} characters: {least} to {longest}')
    return clean
