"""A robot as a script sees it: orders that return at once, and questions how it goes."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path as File
from typing import TYPE_CHECKING

from geometry_msgs.msg import PoseStamped, TwistStamped, Vector3Stamped
from nav_msgs.msg import Path
from std_srvs.srv import SetBool

from agv_motion.client.dispatch import Dispatch, require
from agv_motion.client.drivers import GHOST, ROUTE, STOPS, TREE
from agv_motion.client.link import ScriptLink
from agv_motion.client.order import Patience
from agv_motion.client.task import Feedback, Outcome, Result
from agv_motion.errors import AgvMotionError, ConfigurationError, SourceError
from agv_motion.planar import Pose, require_finite
from agv_motion.ros.messages import fill_path, fill_pose
from agv_motion.route.route import Route
from agv_motion.route.route_file import load_route

if TYPE_CHECKING:
    from collections.abc import Sequence

    from typing_extensions import Self

MOST_LAPS = 1000


class Robot:
    """One robot on the graph. Metres, radians, seconds; the frame in which its nodes drive.

    An order (`go_to`, `follow_route`, `drive_arc`, `spin`, `perform`) returns when the robot has
    taken it, and raises an `AgvMotionError` that says why if it has not; then `is_done`,
    `feedback`, `wait` and `result` tell how it goes. A new order takes the place of the last one.
    """

    def __init__(
        self, namespace: str = '', *, patience: float = 5.0, silent_after: float = 10.0,
        stands_for: float = 60.0, domain: int | None = None,
    ) -> None:  # fmt: skip
        """Find the robot.

        Args:
            namespace: Of the robot, such as ``/oak``; empty for none.
            patience: How long to wait for it to be found, and for each answer [s].
            silent_after: Silence of the robot after which an order has failed [s].
            stands_for: How long it may stand before an order has failed [s].
            domain: ROS domain; None: that of the environment.

        Raises:
            SourceError: No robot is there.
            SignalError: A limit is not finite.

        """
        require_finite('patience, silent_after, stands_for', (patience, silent_after, stands_for))
        self._stopped_by: list[str] = []
        self._link = link = ScriptLink(namespace, domain)
        link.speak(TwistStamped, 'cmd_vel/stop')
        link.know(SetBool, STOPS)
        self._dispatch = Dispatch(link, Patience(patience, silent_after, stands_for))
        try:
            self._dispatch.find()
        except BaseException:
            link.close()
            raise

    # Orders

    def go_to(self, x: float, y: float, heading: float | None = None) -> None:
        """Go to a place.

        Args:
            x: [m]
            y: [m]
            heading: Where to look there [rad]; None: as it arrives. A tree turns as its sap flows,
                and takes none.

        Raises:
            AgvMotionError: The robot has not taken it; the message says why.

        """
        # a message takes a whole number, and sends another one
        x, y = float(x), float(y)
        heading = None if heading is None else float(heading)
        require_finite('go_to (x, y, heading)', (x, y, heading or 0.0))
        driver = self._dispatch.first(GHOST, TREE)
        if driver is TREE:
            self._dispatch.send_tree(x, y, heading)
            return
        if heading is not None:
            goal = PoseStamped()
            fill_pose(goal.pose, Pose(x, y, heading))
            self._dispatch.send(driver, 'goal_pose', goal)
        else:  # twice the same place: the node finds the heading by where it is
            path = Path()
            fill_path(path, [Pose(x, y, 0.0)] * 2)
            self._dispatch.send(driver, 'path', path)

    def follow_route(
        self, route: Sequence[tuple[float, float]] | str | File, *, laps: int = 1
    ) -> None:
        """Follow waypoints, cutting corners smoothly.

        Args:
            route: Two or more places (x, y) [m], or a file of them (CSV or YAML) on this machine.
            laps: How often to go round.

        Raises:
            AgvMotionError: It is no route, or the robot has not taken it.

        """
        if not 1 <= laps <= MOST_LAPS:
            msg = f'laps = {laps}: give 1 to {MOST_LAPS}'
            raise ConfigurationError(msg)
        given = load_route(route, laps) if isinstance(route, (str, File)) else Route(route, laps)
        if given.laps < 1:
            msg = f'{route}: laps = 0 never ends: give 1 or more'
            raise ConfigurationError(msg)
        path = Path()
        fill_path(path, [Pose(float(x), float(y), 0.0) for x, y in given.waypoints * given.laps])
        self._dispatch.send(self._dispatch.first(ROUTE), 'route', path)

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

    # How it goes

    def is_done(self) -> bool:
        """Return whether the order is over: done, failed or cancelled."""
        return self.result().outcome is not Outcome.RUNNING

    def result(self) -> Result:
        """Return how the order ended, with the reason; `Outcome.RUNNING` as long as it has not."""
        return self._dispatch.result()

    def feedback(self) -> Feedback:
        """Return what the robot does, how far it has to go, and why it stands, if it does."""
        return self._dispatch.feedback()

    def wait(self, seconds: float) -> Result:
        """Wait until the order is over, at most so long [s]; nothing is cancelled by that."""
        require_finite('wait (seconds)', (seconds,))
        self._link.wait(self.is_done, seconds)
        return self.result()

    # Ends

    def cancel(self, seconds: float = 10.0) -> Result:
        """Take the order back: brake to rest, with explicit zeros, and let others drive.

        A tree is paused: it walks by itself again after `resume`, or with the next order.

        Args:
            seconds: How long to wait until it stands [s].

        Raises:
            AgvMotionError: It does not answer; then `stop` is left.

        """
        self._dispatch.cancel()
        return self.wait(seconds)

    def resume(self) -> None:
        """Let a tree that was paused walk again.

        Raises:
            AgvMotionError: It is no tree, or does not answer.

        """
        require(self._dispatch.ask(self._dispatch.first(TREE).service, SetBool.Request(data=False)))

    def stop(self) -> None:
        """Hold the wheels at once, until `release`: STOP, above all who drive.

        Raises:
            SourceError: Nobody confirms it: go and press the switch.

        """
        self._link.speak(TwistStamped, 'cmd_vel/stop').publish(TwistStamped())
        self._stopped_by = []
        for service in STOPS:
            if self._link.has(service) and not self._stopped_by:
                with suppress(AgvMotionError):
                    require(self._dispatch.ask(service, SetBool.Request(data=True)))
                    self._stopped_by.append(service)
        self._dispatch.give_up('STOP: asked for by this script')
        if not self._stopped_by:
            msg = (
                'nobody confirms the STOP: neither arbiter nor kinematics answer; press the switch'
            )
            raise SourceError(msg)

    def release(self) -> None:
        """Release a STOP, whoever asked for it. Nothing moves until somebody drives anew.

        Raises:
            AgvMotionError: Nobody there can.

        """
        services = self._stopped_by or STOPS
        there = [service for service in services if self._link.has(service)]
        if not there:
            msg = 'neither an arbiter nor kinematics is there, so nothing can be released'
            raise SourceError(msg)
        require(self._dispatch.ask(there[0], SetBool.Request(data=False)))
        self._stopped_by = []
        if not self._dispatch.wait_for_release():
            msg = f'it was released, but STOP holds again: {self._dispatch.view.stop}'
            raise SourceError(msg)

    def close(self) -> None:
        """Leave the graph; an order under way is taken back first, so that nothing drives alone."""
        try:
            if not self.is_done():
                self.cancel()
        except AgvMotionError:
            pass  # it does not answer: it is told when it does, and stands by its own watchdogs
        finally:
            self._link.close()

    def __enter__(self) -> Self:
        """Return the robot."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close it."""
        self.close()


def _vector(x: float, y: float, z: float) -> Vector3Stamped:
    require_finite('the numbers of an order', (x, y, z))
    message = Vector3Stamped()
    message.vector.x, message.vector.y, message.vector.z = float(x), float(y), float(z)
    return message
