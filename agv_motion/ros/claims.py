"""The claims of trees as standard messages, which RViz shows as the corridors that they are.

A claim is a visualization_msgs/MarkerArray of three line strips as wide as the tree: what it holds,
what it asks for, and where it means to go, with ``ns`` the name of the tree and ``id`` which of the
three. The ``text`` of the first, which RViz does not show for lines, holds the rest as JSON.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import Point
from visualization_msgs.msg import Marker, MarkerArray

from agv_motion.errors import SignalError
from agv_motion.motion.traffic.claim import Claim
from agv_motion.ros.messages import stamp_of

if TYPE_CHECKING:
    from agv_motion.motion.polyline import Way

HELD, ASKED, WISH = range(3)

COLOURS = {HELD: (0.8, 0.2, 0.2, 0.6), ASKED: (0.9, 0.6, 0.1, 0.5), WISH: (0.2, 0.6, 0.3, 0.2)}
"""red, green, blue, opacity of each strip"""


def claim_message(claim: Claim, frame: str) -> MarkerArray:
    """Return ``claim`` as a message in the frame of the map."""
    ways = {HELD: claim.held, ASKED: claim.asked, WISH: claim.wish}
    message = MarkerArray(
        markers=[_strip(claim, frame, number, way) for number, way in ways.items()]
    )
    message.markers[HELD].text = json.dumps(
        {'journey': claim.journey, 'heard': dict(claim.heard), 'parked': claim.parked}
    )
    return message


def _strip(claim: Claim, frame: str, number: int, way: Way) -> Any:
    marker = Marker(ns=claim.name, id=number, type=Marker.LINE_STRIP)
    marker.header.frame_id = frame
    marker.header.stamp = stamp_of(claim.stamp)
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
        SignalError: It is none, in another frame, or a number is not finite.

    """
    strips = {marker.id: marker for marker in message.markers}
    if set(strips) != {HELD, ASKED, WISH} or len({marker.ns for marker in strips.values()}) != 1:
        msg = f'{len(message.markers)} markers are no claim of a tree: expected its three ways'
        raise SignalError(msg)
    first = strips[HELD]
    if first.header.frame_id != frame:
        msg = f"claim of '{first.ns}' in frame '{first.header.frame_id}': expected '{frame}'"
        raise SignalError(msg)
    try:
        rest = json.loads(first.text)
        heard = {str(name): int(stamp) for name, stamp in rest['heard'].items()}
        journey, parked = int(rest['journey']), bool(rest['parked'])
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        msg = f"claim of '{first.ns}' says {first.text!r:.80}: expected journey, heard and parked"
        raise SignalError(msg) from error
    stamp = first.header.stamp
    return Claim(
        first.ns, stamp.sec * 1_000_000_000 + stamp.nanosec, first.scale.x / 2.0,
        _way(first), _way(strips[ASKED]), _way(strips[WISH]), journey, heard, parked,
    )  # fmt: skip


def _way(marker: Any) -> Way:
    points = tuple((point.x, point.y) for point in marker.points)
    return points[:1] if len(points) == 2 and points[0] == points[1] else points
