"""`WS /robots/NAME/drive`: a person's hand, and what keeps a robot from going on without it.

The browser sends what the hand does, twenty times a second, with a counter and its own clock. The
server sends each on once, stamped with when the hand moved, and never repeats anything: when
nothing new comes, or only what was held up on the way, the robot's arbiter stops the wheels. So
closing the page, a network that is gone, a stalled tab and a dead server all end in the same.
"""

from __future__ import annotations

import asyncio
import time
from math import hypot
from typing import TYPE_CHECKING, Any

from starlette.websockets import WebSocketDisconnect

from agv_motion.dashboard.server.door import known_robot, require_role, require_token
from agv_motion.dashboard.server.requests import RequestError, number, parsed
from agv_motion.dashboard.server.roles import Role
from agv_motion.planar import REST, Twist

if TYPE_CHECKING:
    from starlette.websockets import WebSocket

    from agv_motion.dashboard.server.roles import Visitor
    from agv_motion.dashboard.server.site import Site

FIRST = 5.0
"""[s] within which the token must come"""
FASTEST = 10.0
"""[m/s], [rad/s] beyond which a number is a mistake; what the robot may do it knows itself"""
OTHER = 1.0
"""[s] for which a hand that has moved keeps others from the robot"""
OLDEST = 0.3
"""[s] beyond which the arbiter refuses a command; such are not even sent"""
TOLERATED = 0.5
"""[s] for which commands may be too old before the person is told"""
DRIFT = 1e-4
"""by which the browser's clock may run faster or slower than ours"""
MOST_PER_SECOND = 100
NEAREST = 0.5
"""[m] A speed about a centre nearer than this is that of a point so far from it."""
KEYS = ('n', 't', 'vx', 'vy', 'wz', 'icr', 'speed')


class BrowserClock:
    """The clock of a browser on ours: the least delay ever seen counts as none.

    A message that took longer than the quickest one did is older by the difference. So nothing that
    was held up passes for new, whatever the browser's clock shows. What two clocks part by in hours
    is allowed for.
    """

    def __init__(self) -> None:
        """Know nothing of the other clock."""
        self._offset: float | None = None
        """ours less the browser's, of the quickest message [s]"""
        self._last = 0.0

    def age(self, theirs: float, ours: float) -> float:
        """Return how long a message was on its way at least [s].

        Args:
            theirs: When it was sent [s], on the browser's clock.
            ours: When it came [s].

        """
        offset = ours - theirs
        if self._offset is None:
            self._offset = offset
        self._offset = min(offset, self._offset + DRIFT * (ours - self._last))
        self._last = ours
        return offset - self._offset


async def drive(site: Site, socket: WebSocket) -> None:
    """Let a visitor drive a robot by hand, until it leaves."""
    try:
        visitor = site.access.visitor(socket)
        require_role(visitor, Role.OPERATOR)
        robot = known_robot(site, str(socket.path_params['robot']))
    except RequestError as error:
        await socket.close(1008, str(error)[:120])
        return
    await socket.accept()
    try:
        first = parsed(await asyncio.wait_for(socket.receive_text(), FIRST), ('csrf',))
        require_token(site, visitor, str(first.get('csrf', '')))
        await _Hand(site, robot, socket, visitor).follow()
    except asyncio.TimeoutError:
        await socket.close(1008, 'no token came')
    except RequestError as error:
        await socket.close(1008, str(error)[:120])
    except (WebSocketDisconnect, RuntimeError, KeyError):
        return  # it left; the arbiter stops the wheels


class CommandRate:
    """How many commands came in this second."""

    def __init__(self) -> None:
        """Begin the first second with the first command."""
        self._since, self._count = 0.0, 0

    def is_first(self, now: float) -> bool:
        """Count a command; return whether it is the first of a second.

        Raises:
            RequestError: It is one too many.

        """
        first = now - self._since > 1.0
        if first:
            self._since, self._count = now, 0
        self._count += 1
        if self._count > MOST_PER_SECOND:
            raise RequestError(429, f'more than {MOST_PER_SECOND} commands a second')
        return first


class Lateness:
    """Whether commands are refused for their age so long that the person must know.

    A machine that slept has another clock than before, and nothing else would tell.
    """

    def __init__(self) -> None:
        """Begin with nothing told."""
        self.clock = BrowserClock()
        self._taken = time.monotonic()
        """when the last command was new enough"""
        self._told = False

    def news(self, age: float, now: float, *, refused: bool) -> str | None:
        """Take a command; return what to tell: words, none once commands count again, or None.

        Args:
            age: Of the command [s].
            now: When it came [s], on the clock of `time.monotonic`.
            refused: Whether it is too old.

        """
        if not refused:
            self._taken = now
        late = now - self._taken > TOLERATED
        if late == self._told:
            return None
        self._told = late
        words = f'commands come {age:.1f} s late and are refused: close this panel, open it again'
        return words if late else ''


class _Hand:
    """One hand on one robot."""

    def __init__(self, site: Site, robot: str, socket: WebSocket, visitor: Visitor) -> None:
        self._site, self._robot, self._socket = site, robot, socket
        self._visitor = visitor
        self._last = -1.0
        self._rate = CommandRate()
        self._lateness = Lateness()

    async def follow(self) -> None:
        """Send on what the hand does, until the browser leaves."""
        try:
            while True:
                told = parsed(await self._socket.receive_text(), KEYS)
                now = time.monotonic()
                if self._rate.is_first(now):
                    self._require_session()
                count, sent = number(told, 'n', 0.0, 1e15), number(told, 't', -1e15, 1e15)
                age = self._lateness.clock.age(sent / 1000.0, now)
                twist = twist_of(told, self._rim())
                if count <= self._last:
                    continue  # overtaken
                self._last = count
                self._require_alone(twist, now)
                late = age >= OLDEST and twist != REST
                if not late:
                    self._site.fleet.drive(self._robot, twist, age)
                words = self._lateness.news(age, now, refused=late)
                if words is not None:
                    await self._socket.send_json({'text': words})
        finally:
            if self._site.drivers.get(self._robot, (None, 0.0))[0] is self:
                del self._site.drivers[self._robot]

    def _require_session(self) -> None:
        if self._site.access.visitor(self._socket) != self._visitor:
            raise RequestError(401, 'the session has ended: log in again')

    def _require_alone(self, twist: Twist, now: float) -> None:
        """Refuse a second hand while the first one moves."""
        hand, moved = self._site.drivers.get(self._robot, (self, 0.0))
        if hand is not self and now - moved < OTHER and twist != REST:
            raise RequestError(409, f'another person drives {self._robot}')
        if twist != REST:
            self._site.drivers[self._robot] = self, now

    def _rim(self) -> float:
        robot = self._site.fleet.board.robots.get(self._robot)
        radius = None if robot is None else robot.platform.get('radius')
        return radius if isinstance(radius, float) and radius > 0.0 else NEAREST


def twist_of(told: dict[str, Any], rim: float) -> Twist:
    """Return the twist that a message asks for.

    Args:
        told: ``vx``, ``vy`` [m/s] and ``wz`` [rad/s]; or ``icr``, a point [m] in the robot's frame
            about which it is to turn, and ``speed`` [m/s], positive counter-clockwise: that of the
            robot's centre, or of its rim where the point lies within.
        rim: How far the robot reaches from its centre [m].

    Raises:
        RequestError: It is neither, or a number is none or out of its limits.

    """
    if 'icr' not in told:
        return Twist(*(number(told, key, -FASTEST, FASTEST) for key in ('vx', 'vy', 'wz')))
    point = told['icr']
    if not isinstance(point, list) or len(point) != 2:
        raise RequestError(422, f'icr = {str(point)[:60]!r}: expected x and y in metres')
    x, y = (number({'icr': value}, 'icr') for value in point)
    wz = number(told, 'speed', -FASTEST, FASTEST) / max(hypot(x, y), rim)
    return Twist(wz * y, -wz * x, wz)
