"""Orders to a robot: each returns once it is taken, and raises an error that says why if not."""

from __future__ import annotations

from pathlib import Path as File
from typing import TYPE_CHECKING

from geometry_msgs.msg import PoseStamped, Vector3Stamped
from nav_msgs.msg import Path

from agv_motion.client.drivers import GHOST, ROUTE, TREE
from agv_motion.errors import ConfigurationError, SignalError, shortened
from agv_motion.planar import Pose, require_finite
from agv_motion.ros.messages import fill_path, fill_pose
from agv_motion.route.route import MOST_WAYPOINTS, Route
from agv_motion.route.route_file import load_route

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.client.dispatch import Dispatch

MOST_LAPS = 1000
STRAIGHT = 2e6
"""[m] Diameter of a circle that is as good as a straight line."""


class Orders:
    """What a robot can be told to do. Metres, radians, seconds."""

    def __init__(self, dispatch: Dispatch) -> None:
        """Send orders by ``dispatch``."""
        self._dispatch = dispatch

    def go_to(self, x: float, y: float, heading: float | None = None, *, frame: str = '') -> None:
        """Go to a place.

        Args:
            x: [m]
            y: [m]
            heading: Where to look there [rad]; None: as it arrives. A tree turns as its sap flows,
                and takes none.
            frame: In which all that is told; empty: in that in which its nodes drive.

        Raises:
            AgvMotionError: The robot has not taken it; the message says why.

        """
        name = 'go_to (x, y, heading)'
        if heading is None:
            x, y = _numbers(name, x, y)
        else:
            x, y, heading = _numbers(name, x, y, heading)
        driver = self._dispatch.first(GHOST, TREE)
        if driver is TREE:
            self._dispatch.send_tree(x, y, heading, frame)
            return
        if heading is not None:
            goal = PoseStamped()
            goal.header.frame_id = frame
            fill_pose(goal.pose, Pose(x, y, heading))
            self._dispatch.send(driver, 'goal_pose', goal)
        else:  # twice the same place: the node finds the heading by where it is
            self._dispatch.send(driver, 'path', _path([Pose(x, y, 0.0)] * 2, frame))

    def takes_headings(self) -> bool:
        """Return whether it can be told where to look: a tree cannot."""
        return self._dispatch.first(GHOST, TREE) is not TREE

    def follow_path(self, poses: Sequence[Pose], *, frame: str = '') -> None:
        """Drive on one curve through poses, with their headings.

        Args:
            poses: Through which, the last of them the goal.
            frame: In which they are; empty: in that in which its nodes drive.

        Raises:
            AgvMotionError: The robot has not taken it; the message says why.

        """
        given = [Pose(*_numbers('a pose (x, y, heading)', *pose, count=3)) for pose in poses]
        self._dispatch.send(self._dispatch.first(GHOST), 'path', _path(given, frame))

    def follow_route(
        self, route: Sequence[tuple[float, float]] | str | File, *, laps: int = 1, frame: str = ''
    ) -> None:
        """Follow waypoints, cutting corners smoothly.

        Args:
            route: Two or more places (x, y) [m], or a file of them (CSV or YAML) on this machine.
            laps: How often to go round, where a file does not say; whatever `laps` of its node is.
            frame: In which they are; empty: in that in which its nodes drive.

        Raises:
            AgvMotionError: It is no route, or the robot has not taken it.

        """
        if not isinstance(laps, int) or not 1 <= laps <= MOST_LAPS:
            msg = f'laps = {laps}: give a whole number from 1 to {MOST_LAPS}'
            raise ConfigurationError(msg)
        given = load_route(route, laps) if isinstance(route, (str, File)) else Route(route, laps)
        if given.laps < 1:
            msg = f'{route}: laps = 0 never ends: give 1 or more'
            raise ConfigurationError(msg)
        if len(given.waypoints) * given.laps > MOST_WAYPOINTS:
            msg = f'{len(given.waypoints)} waypoints, {given.laps} times: {MOST_WAYPOINTS} at most'
            raise ConfigurationError(msg)
        places = [Pose(float(x), float(y), 0.0) for x, y in given.waypoints * given.laps]
        self._dispatch.send(self._dispatch.first(ROUTE), 'route', _path(places, frame))

    def drive_arc(self, angle: float, diameter: float, speed: float = 0.3) -> None:
        """Drive along a circle.

        Args:
            angle: Of the arc [rad]; above 0 its centre is on the left.
            diameter: Of the inner wheel's circle [m]; 0: pivot on that wheel.
            speed: Of the outer wheel [m/s]; below 0: backwards.

        Raises:
            AgvMotionError: The robot has not taken it; the message says why.

        """
        self._dispatch.send(self._dispatch.first(GHOST), 'arc', _vector(angle, diameter, speed))

    def drive_straight(self, distance: float, speed: float = 0.3) -> None:
        """Drive straight on from where the robot stands.

        Args:
            distance: How far [m]; below 0: backwards.
            speed: How fast, above 0 [m/s].

        Raises:
            AgvMotionError: The robot has not taken it; the message says why.

        """
        # an arc so large that 100 m of it end 5 mm beside the straight line
        distance, speed = _numbers('drive_straight (distance, speed)', distance, speed)
        if speed <= 0.0 or not distance:
            msg = f'drive_straight: {distance:g} m at {speed:g} m/s: give a distance, speed above 0'
            raise ConfigurationError(msg)
        angle = 2.0 * abs(distance) / STRAIGHT
        self.drive_arc(angle, STRAIGHT, speed if distance > 0.0 else -speed)

    def spin(self, angle: float, turn_rate: float = 0.5, ramps: float = 1.0) -> None:
        """Turn on the spot.

        Args:
            angle: How far, of any size [rad]; above 0 to the left.
            turn_rate: How fast [rad/s].
            ramps: How fast that changes [rad/s2].

        Raises:
            AgvMotionError: The robot has not taken it; the message says why.

        """
        self._dispatch.send(self._dispatch.first(GHOST), 'turn', _vector(angle, ramps, turn_rate))

    def perform(self, file: str) -> None:
        """Perform a sequence of actions.

        Args:
            file: Of the actions, on the machine of the robot.

        Raises:
            AgvMotionError: The robot has not taken it; the message says why.

        """
        self._dispatch.send_sequence(file)

    def set_pose(self, x: float, y: float, heading: float) -> None:
        """Tell its localization where the robot is: for one that finds out only once it moves.

        Args:
            x: [m] in the map, to half a metre.
            y: [m]
            heading: To 15 degrees [rad].

        Raises:
            AgvMotionError: It has no localization, or that does not believe it.

        """
        self._dispatch.set_pose(Pose(*_numbers('set_pose (x, y, heading)', x, y, heading)))


def _path(poses: Sequence[Pose], frame: str) -> Path:
    path = Path()
    path.header.frame_id = frame
    fill_path(path, poses)
    return path


def _vector(x: float, y: float, z: float) -> Vector3Stamped:
    message = Vector3Stamped()
    vector, numbers = message.vector, _numbers('the numbers of an order', x, y, z)
    vector.x, vector.y, vector.z = numbers
    return message


def _numbers(name: str, *values: float, count: int | None = None) -> tuple[float, ...]:
    """Return values as decimal numbers: a message takes a whole one, and sends another.

    Args:
        name: What they are, for the error.
        values: What somebody gave, of whatever type.
        count: How many there have to be; None: any.

    Raises:
        SignalError: One is no finite number, or their count is wrong.

    """
    try:
        numbers = tuple(map(float, values))
    except (TypeError, ValueError, OverflowError):
        numbers = ()
    if len(numbers) != (len(values) if count is None else count):
        msg = f'{name}: {shortened(str(values))}: give numbers'
        raise SignalError(msg)
    require_finite(name, numbers)
    return numbers
