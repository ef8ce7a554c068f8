"""Numbers, texts and sizes that may go out to a browser, whatever a message says."""

from __future__ import annotations

from itertools import islice
from math import atan2, isfinite
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

DIGITS = 4
"""of metres, radians and seconds: a tenth of a millimetre is more than anybody sees"""
MOST_POINTS = 500
"""of a path or an outline that is drawn"""
MOST_JOINTS = 32
"""turrets or wheels of one robot"""
LONGEST_TEXT = 1000
"""characters of a text that a robot says"""


def finite(value: Any, digits: int = DIGITS) -> float | None:
    """Return a number rounded; None where it is none that can be shown (NaN, infinity)."""
    if type(value) is float:  # as nearly all are: this is called thousands of times a second
        return round(value, digits) if isfinite(value) else None
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        return None
    return round(number, digits) if isfinite(number) else None


def listed(values: Iterable[Any], most: int = MOST_JOINTS) -> list[float | None]:
    """Return numbers, at most ``most`` of them, None for each that cannot be shown."""
    return [finite(value) for value in islice(values, most)]


def thinned(items: Sequence[Any], most: int = MOST_POINTS) -> list[Any]:
    """Return at most ``most`` items, evenly, the first and the last among them."""
    count = len(items)
    if count <= most:
        return list(items)
    return [items[i * (count - 1) // (most - 1)] for i in range(most)]


def text_of(value: Any, most: int = LONGEST_TEXT) -> str:
    """Return a text without characters of control, cut where it is too long."""
    text = ''.join(c if c.isprintable() else ' ' for c in str(value)[: most + 1])
    return text if len(text) <= most else f'{text[: most - 4]} ...'


def heading_of(quaternion: Any) -> float | None:
    """Return the angle about z [rad] of a geometry_msgs/Quaternion."""
    x, y, z, w = (finite(getattr(quaternion, axis), 9) for axis in 'xyzw')
    if x is None or y is None or z is None or w is None:
        return None
    return finite(atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)))


def point_of(point: Any) -> list[float | None]:
    """Return x and y of a geometry_msgs/Point."""
    return [finite(point.x), finite(point.y)]


def known(point: Sequence[float | None]) -> bool:
    """Return whether a point can be drawn."""
    return None not in point
