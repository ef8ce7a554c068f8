"""The claims of trees as standard messages, which RViz shows as the corridors that they are.

A claim is a visualization_msgs/MarkerArray of three line strips as wide as the tree: what it holds,
what it asks for, and where it means to go, with ``ns`` the name of the tree and ``id`` which of the
three. The ``text`` of the first, which RViz does not show for lines, holds the rest as JSON: run
and number of the message and of those it has heard, journey, margin, and whether the tree is
parked. Whoever publishes on the topic may say anything, so all is checked before it is believed.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, NamedTuple

from geometry_msgs.msg import Point
from visualization_msgs.msg import Marker, MarkerArray

from agv_motion.errors import SignalError
from agv_motion.motion.traffic.claim import MOST_POINTS, Claim, Word
from agv_motion.ros.messages import stamp_of

if TYPE_CHECKING:
    from agv_motion.motion.polyline import Way

HELD, ASKED, WISH = range(3)

COLOURS = {HELD: (0.8, 0.2, 0.2, 0.6), ASKED: (0.9, 0.6, 0.1, 0.5), WISH: (0.2, 0.6, 0.3, 0.2)}
"""red, green, blue, opacity of each strip"""


PARKED = {True: True, False: False}
"""what may stand for it, and nothing else"""

LONGEST_TEXT = 100_000
"""[1] characters of the text"""


def claim_message(claim: Claim, frame: str, stamp: float) -> MarkerArray:
    """Return ``claim`` as a message in the frame of the map, stamped with a time [s]."""
    ways = {HELD: claim.held, ASKED: claim.asked, WISH: claim.wish}
    message = MarkerArray(
        markers=[_strip(claim, frame, number, way) for number, way in ways.items()]
    )
    told = {
        'run': claim.word.run, 'number': claim.word.number, 'journey': claim.journey,
        'margin': claim.margin, 'heard': dict(claim.heard), 'parked': claim.parked,
    }  # fmt: skip
    message.markers[HELD].text = json.dumps(told)
    nanoseconds = round(stamp * 1e9)
    for marker in message.markers:
        marker.header.stamp = stamp_of(nanoseconds)
    return message


def _strip(claim: Claim, frame: str, number: int, way: Way) -> Any:
    marker = Marker(ns=claim.name, id=number, type=Marker.LINE_STRIP)
    marker.header.frame_id = frame
    marker.action = Marker.ADD if way else Marker.DELETE
    marker.pose.orientation.w = 1.0
    marker.scale.x = 2.0 * claim.radius
    colour = marker.color
    colour.r, colour.g, colour.b, colour.a = COLOURS[number]
    ends = (*way, *way) if len(way) == 1 else way  # a strip has two points at least
    marker.points = [Point(x=x, y=y) for x, y in ends]
    return marker


def claim_of(message: Any, frame: str) -> Claim:
    """Return the claim in ``message``.

    Raises:
        SignalError: It is none, in another frame, too long, or a number is not finite or no sense.

    """
    strips = {marker.id: marker for marker in message.markers[:4]}
    if (
        set(strips) != {HELD, ASKED, WISH}
        or len(message.markers) != 3
        or len({marker.ns for marker in strips.values()}) != 1
    ):
        msg = f'{len(message.markers)} markers are no claim of a tree: expected its three ways'
        raise SignalError(msg)
    first = strips[HELD]
    for strip in strips.values():
        _check(strip, frame)
    held, asked, wish = (_way(strips[number]) for number in (HELD, ASKED, WISH))
    told = _told_by(first)
    return Claim(
        first.ns, told.word, first.scale.x / 2.0, held, asked, wish, told.journey, told.heard,
        told.parked, told.margin,
    )  # fmt: skip


class _Told(NamedTuple):
    word: Word
    journey: int
    heard: dict[str, Word]
    parked: bool
    margin: float


def _check(strip: Any, frame: str) -> None:
    """Refuse a strip that lies elsewhere than it seems, or is too long to be read.

    Raises:
        SignalError: It does, or is.

    """
    name = f"claim of '{strip.ns:.40}'"
    if strip.header.frame_id != frame:
        msg = f"{name} in frame '{strip.header.frame_id:.40}': expected '{frame}'"
        raise SignalError(msg)
    position = strip.pose.position
    if (position.x, position.y) != (0.0, 0.0) or abs(strip.pose.orientation.w) != 1.0:
        msg = f'{name} has points relative to a pose: expected points in the frame itself'
        raise SignalError(msg)
    if len(strip.points) > MOST_POINTS or len(strip.text) > LONGEST_TEXT:
        msg = (
            f'{name} has {len(strip.points)} points and {len(strip.text)} characters: at most '
            f'{MOST_POINTS} and {LONGEST_TEXT}'
        )
        raise SignalError(msg)


def _told_by(first: Any) -> _Told:
    """Return what the text of the first strip says.

    Raises:
        SignalError: It says something else.

    """
    try:
        told = json.loads(first.text)
        heard = {str(name): Word(*map(_count, word)) for name, word in told['heard'].items()}
        return _Told(
            Word(_count(told['run']), _count(told['number'])), _count(told['journey']), heard,
            PARKED[told['parked']], float(told['margin']),
        )  # fmt: skip
    except (
        ValueError, LookupError, TypeError, AttributeError, OverflowError, RecursionError,
    ) as error:  # fmt: skip
        msg = (
            f"claim of '{first.ns:.40}' says {first.text[:80]!r}: expected run, number, journey, "
            'margin, heard and parked'
        )
        raise SignalError(msg) from error


def _count(value: Any) -> int:
    """Return a whole number.

    Raises:
        TypeError: It is none.

    """
    if not isinstance(value, int) or isinstance(value, bool):
        raise TypeError(value)
    return value


def _way(marker: Any) -> Way:
    points = tuple((point.x, point.y) for point in marker.points)
    return points[:1] if len(points) == 2 and points[0] == points[1] else points
