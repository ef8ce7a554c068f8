"""What the page knows: the newest value of each slot of each robot, with its time.

Whoever hears the robots calls :meth:`Board.receive`, from any thread; it only puts the message in
its place, so the newest replaces what nobody has looked at. :meth:`Board.refresh` makes of them the
cells that are sent, each once for all clients.
"""

from __future__ import annotations

import json
from collections import deque
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.dashboard.core import conversions
from agv_motion.dashboard.core.drank import drank
from agv_motion.dashboard.core.entry import Entry
from agv_motion.dashboard.core.health import health
from agv_motion.dashboard.core.names import FIELDS, MOST_ROBOTS, robot_of, type_of
from agv_motion.dashboard.core.numbers import finite
from agv_motion.dashboard.core.robot_state import NodeWord, RobotState
from agv_motion.dashboard.core.slots import SLOTS, Slot
from agv_motion.dashboard.core.summary import summary

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

SLOWLY = 1.0
"""[s] between two looks at what changes slowly: health, trail, chart, reservations"""
WAITING = 100
"""messages of a topic with many publishers that are kept until the next look"""
MOST_NAMES = 60
"""nodes of one robot, and trees that reserve floor, that are kept"""


_ENCODER = json.JSONEncoder(
    allow_nan=False, separators=(',', ':'), ensure_ascii=False, check_circular=False
)


class Cell(NamedTuple):
    """A slot as it is sent."""

    version: int
    """greater than that of any cell before it"""
    at: float
    """when that was so [s]"""
    update: str
    """robot, topic, time and value as JSON, as it goes to every client"""


class Board:
    """The newest of everything, for up to `MOST_ROBOTS` robots."""

    def __init__(self) -> None:
        """Know nothing."""
        self.robots: dict[str, RobotState] = {}
        self.cells: dict[tuple[str, str], Cell] = {}
        """by robot (``''``: of all) and slot"""
        self.on_request = {slot.name for slot in SLOTS if slot.on_request} | {'parameters'}
        self.time: float | None = None
        """of the robots [s since 1970], where a simulation tells it"""
        self.factor: float | None = None
        """seconds of the robots per second"""
        self._shared: dict[str, deque[Entry]] = {
            name: deque(maxlen=WAITING) for name in ('diagnostics', 'reservations')
        }
        self._clock: Entry | None = None
        self._clock_before: tuple[float, float] | None = None
        self._heard_clock = 0.0
        self._held: dict[str, Any] = {}
        """newest reservation of each tree"""
        self._values: dict[tuple[str, str], Any] = {}
        """what was put in each cell that is made elsewhere"""
        self._made: dict[tuple[str, str], int] = {}
        self._version = 0
        self._slowly = 0.0

    def robot(self, name: str) -> RobotState | None:
        """Return a robot, made where it is new; None if there are `MOST_ROBOTS` already."""
        found = self.robots.get(name)
        if found is None and len(self.robots) < MOST_ROBOTS:
            found = self.robots[name] = RobotState(name)
        return found

    def receive(
        self, robot: str, topic: str, at: float, data: Any,
        decode: Callable[[Any], Any] | None = None,
    ) -> None:  # fmt: skip
        """Take a message, in place of what came before it.

        Args:
            robot: Name; empty for a topic that all share.
            topic: Relative to the robot.
            at: When it came [s], on the clock of the board.
            data: The message, or its bytes.
            decode: Makes a message of the bytes; may raise whatever it likes.

        """
        entry = Entry(at, data, decode, FIELDS.get(type_of(topic), ()))
        if robot:
            found = self.robot(robot)
            if found is not None:
                found.latest[topic] = entry
        elif topic == 'clock':
            self._clock = entry
        elif topic in self._shared:
            self._shared[topic].append(entry)

    def set_platform(self, robot: str, platform: dict[str, Any]) -> None:
        """Take the shape of a robot: kind, outline or radius, turrets or wheels, wheel radius."""
        found = self.robot(robot)
        if found is not None and platform != found.platform:
            found.platform = platform
            found.platform_number += 1

    def put(self, robot: str, slot: str, at: float, value: Any, *, renew: bool = False) -> None:
        """Set a cell that is made elsewhere; the same again changes nothing unless to ``renew``."""
        key = robot, slot
        if renew or key not in self.cells or self._values[key] != value:
            self._values[key] = value
            self._set(key, at, value)

    def refresh(self, now: float, wanted: Iterable[tuple[str, str]] = ()) -> None:
        """Make the cells of what has come, as of ``now`` [s].

        Args:
            now: On the clock of the board.
            wanted: Robot and slot of what is made on request only.

        """
        asked = set(wanted)
        slowly = self.look(now)
        for robot in list(self.robots.values()):
            for slot in SLOTS:
                if not slot.on_request or (robot.name, slot.name) in asked:
                    self._refresh(robot, slot, now)
            self._refresh_robot(robot, now, slowly=slowly)
        if slowly and self._held:
            self.put('', 'reservations', now, conversions.reservations(self._held))

    def look(self, now: float) -> bool:
        """Take in what changes slowly, at most once in `SLOWLY`; return whether it was time to.

        Trails, charts, what nodes say of themselves, and the time of a simulation are known though
        nobody looks.
        """
        if 0.0 <= now - self._slowly < SLOWLY:
            return False
        self._slowly = now
        self._look_at_clock()
        for entry in _taken(self._shared['diagnostics']):
            self._note_nodes(entry)
        for entry in _taken(self._shared['reservations']):
            self._note_reservation(entry)
        for robot in list(self.robots.values()):
            self._note_place(robot, now)
        return True

    def time_of_robots(self, now: float) -> float:
        """Return the time of the robots [s since 1970] at ``now`` [s]; goes on if they stand."""
        if self.time is None or self._clock_before is None:
            return now
        return self.time + max(now - self._heard_clock, 0.0)

    def _refresh(self, robot: RobotState, slot: Slot, now: float) -> None:
        """Make a slot anew if one of its topics has spoken."""
        entries = [robot.latest[topic] for topic in slot.sources if topic in robot.latest]
        if not entries:
            return
        number = max(entry.number for entry in entries) + robot.platform_number
        key = robot.name, slot.name
        if self._made.get(key) == number:
            return
        self._made[key] = number
        try:
            value = slot.make(robot)
        except Exception:  # noqa: BLE001 - a message of a stranger under a name that we know
            value = None
        if value is not None:
            self._set(key, min(entries[0].at, now), value)

    def _set(self, key: tuple[str, str], at: float, value: Any) -> None:
        """Make a new cell, once for all clients."""
        robot, slot = key
        self._version += 1
        update = (
            f'{{"robot":{as_json(robot)},"topic":{as_json(slot)},"at":{at:.3f},'
            f'"value":{as_json(value)}}}'
        )
        self.cells[key] = Cell(self._version, at, update)

    def _refresh_robot(self, robot: RobotState, now: float, *, slowly: bool) -> None:
        """Make what is told of a robot as a whole."""
        self.put(robot.name, 'summary', now, summary(robot, now), renew=slowly)
        if robot.platform:
            self.put(robot.name, 'platform', now, robot.platform | {'kind': robot.kind})
        if not slowly:
            return
        self.put(robot.name, 'health', now, health(robot, now))
        if robot.trail_number:
            self.put(robot.name, 'trail', now, {'points': robot.trail.points()})
        day = robot.day.value() if robot.day_number else None
        if day is not None:
            self.put(robot.name, 'day', now, day)
        water = drank(robot, self.time_of_robots(now), day and day['drunk'])
        if water is not None:
            self.put(robot.name, 'drank', now, water)

    def _look_at_clock(self) -> None:
        entry, self._clock = self._clock, None
        if entry is None or entry.message is None:
            return
        stamp = entry.message.clock
        time = finite(stamp.sec + 1e-9 * stamp.nanosec, 3)
        if time is None:
            return
        self.time, self._heard_clock = time, entry.at
        before = self._clock_before
        if before is None or entry.at - before[0] >= SLOWLY:
            if before is not None:
                self.factor = finite((time - before[1]) / (entry.at - before[0]), 1)
            self._clock_before = entry.at, time
            self.put('', 'clock', entry.at, {'time': time, 'factor': self.factor})

    def _note_nodes(self, entry: Entry) -> None:
        """Keep what nodes say of themselves, each at its robot."""
        for status in getattr(entry.message, 'status', ())[:MOST_NAMES]:
            told = conversions.status(status)
            namespace, _, name = told['name'].rpartition('/')
            robot = self.robots.get(robot_of(namespace))
            if robot is not None and (name in robot.nodes or len(robot.nodes) < MOST_NAMES):
                before = robot.nodes.get(name)
                period = 0.0 if before is None else max(entry.at - before.at, 0.0)
                robot.nodes[name] = NodeWord(entry.at, told, period)

    def _note_reservation(self, entry: Entry) -> None:
        markers = getattr(entry.message, 'markers', ())
        name = str(markers[0].ns)[:60] if markers else ''
        if name and (name in self._held or len(self._held) < MOST_NAMES):
            self._held[name] = entry.message

    def _note_place(self, robot: RobotState, now: float) -> None:
        message = robot.message('pose')
        if message is not None:
            try:
                place = message.pose.pose.position
                x, y = finite(place.x), finite(place.y)
            except AttributeError:
                return
            if x is not None and y is not None and robot.trail.add(now, x, y):
                robot.trail_number += 1
        flow = robot.message('granier/sap_flow')
        if flow is not None:
            stamp = flow.header.stamp
            flows = conversions.sap_flow(flow)['s']
            if robot.day.add(stamp.sec + 1e-9 * stamp.nanosec, flows):
                robot.day_number += 1


def _taken(waiting: deque[Entry]) -> list[Entry]:
    """Return and remove what has come; another thread may go on adding."""
    return [waiting.popleft() for _ in range(len(waiting))]


def as_json(value: Any) -> str:
    """Return a value as JSON; a number that JSON does not have is refused."""
    return _ENCODER.encode(value)
