"""The reservations of trees as standard messages, which RViz shows as the corridors that they are.

A reservation is a visualization_msgs/MarkerArray of three line strips as wide as the tree: what it
holds, what it asks for, and where it means to go, with ``ns`` the name of the tree and ``id`` which
of the three. The ``text`` of the first, which RViz does not show for lines, holds the rest as JSON:
run and number of the message and of those it has heard, journey, margin, and whether the tree is
parked. Whoever publishes on the topic may say anything, so all is checked before it is believed.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, NamedTuple

from geometry_msgs.msg import Point
from visualization_msgs.msg import Marker, MarkerArray

from agv_motion.errors import SignalError
from agv_motion.motion.navigation.reservations.reservation import (
    MOST_POINTS,
    MessageId,
    Reservation,
)
from agv_motion.ros.messages import stamp_of

if TYPE_CHECKING:
    from agv_motion.motion.navigation.polyline import Path

HELD, REQUESTED, PLANNED = range(3)

COLOURS = {
    HELD: (0.8, 0.2, 0.2, 0.6),
    REQUESTED: (0.9, 0.6, 0.1, 0.5),
    PLANNED: (0.2, 0.6, 0.3, 0.2),
}
"""red, green, blue, opacity of each strip"""


PARKED = {True: True, False: False}
"""what may stand for it, and nothing else"""

LONGEST_TEXT = 100_000
"""[1] characters of the text"""


def reservation_message(reservation: Reservation, frame: str, stamp: int) -> MarkerArray:
    """Return ``reservation`` as a message in the frame of the map, stamped with a time [ns]."""
    paths = {HELD: reservation.held, REQUESTED: reservation.requested, PLANNED: reservation.planned}
    message = MarkerArray(
        markers=[_strip(reservation, frame, number, path) for number, path in paths.items()]
    )
    told = {
        'run': reservation.message_id.run, 'number': reservation.message_id.number,
        'journey': reservation.journey, 'margin': reservation.margin,
        'heard': dict(reservation.received), 'parked': reservation.parked,
    }  # fmt: skip
    message.markers[HELD].text = json.dumps(told)
    for marker in message.markers:
        marker.header.stamp = stamp_of(stamp)
    return message


def _strip(reservation: Reservation, frame: str, number: int, path: Path) -> Any:
    marker = Marker(ns=reservation.name, id=number, type=Marker.LINE_STRIP)
    marker.header.frame_id = frame
    marker.action = Marker.ADD if path else Marker.DELETE
    marker.pose.orientation.w = 1.0
    marker.scale.x = 2.0 * reservation.radius
    colour = marker.color
    colour.r, colour.g, colour.b, colour.a = COLOURS[number]
    ends = (*path, *path) if len(path) == 1 else path  # a strip has two points at least
    marker.points = [Point(x=x, y=y) for x, y in ends]
    return marker


def reservation_of(message: Any, frame: str) -> Reservation:
    """Return the reservation in ``message``.

    Raises:
        SignalError: It is none, in another frame, too long, or a number is not finite or no sense.

    """
    strips = {marker.id: marker for marker in message.markers[:4]}
    if (
        set(strips) != {HELD, REQUESTED, PLANNED}
        or len(message.markers) != 3
        or len({marker.ns for marker in strips.values()}) != 1
    ):
        msg = (
            f'{len(message.markers)} markers are no reservation of a tree: expected its three ways'
        )
        raise SignalError(msg)
    first = strips[HELD]
    for strip in strips.values():
        _check(strip, frame)
    held, requested, planned = (_path(strips[number]) for number in (HELD, REQUESTED, PLANNED))
    told = _told_by(first)
    return Reservation(
        first.ns, told.message_id, first.scale.x / 2.0, held, requested, planned, told.journey,
        told.received, told.parked, told.margin,
    )  # fmt: skip


class _Told(NamedTuple):
    message_id: MessageId
    journey: int
    received: dict[str, MessageId]
    parked: bool
    margin: float


def _check(strip: Any, frame: str) -> None:
    """Refuse a strip that lies elsewhere than it seems, or is too long to be read.

    Raises:
        SignalError: It does, or is.

    """
    name = f"reservation of '{strip.ns:.40}'"
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
        received = {
            str(name): MessageId(*map(_count, message_id))
            for name, message_id in told['heard'].items()
        }
        return _Told(
            MessageId(_count(told['run']), _count(told['number'])), _count(told['journey']),
            received, PARKED[told['parked']], float(told['margin']),
        )  # fmt: skip
    except (
        ValueError, LookupError, TypeError, AttributeError, OverflowError, RecursionError,
    ) as error:  # fmt: skip
        msg = (
            f"reservation of '{first.ns:.40}' says {first.text[:80]!r}: expected run, number, "
            'journey, margin, heard and parked'
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


def _path(marker: Any) -> Path:
    points = tuple((point.x, point.y) for point in marker.points)
    return points[:1] if len(points) == 2 and points[0] == points[1] else points
