"""What a person on the page asks of a robot, as messages and services of its nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import PoseStamped, TwistStamped
from nav_msgs.srv import SetMap
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger

from agv_motion.dashboard.core.names import namespace_of
from agv_motion.dashboard.server.fleet import RefusedError
from agv_motion.planar import REST, Pose, Twist, without_minus_zero
from agv_motion.ros.messages import fill_pose, fill_twist, stamp_of
from agv_motion.ros.qos import COMMAND

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.nodes.robot_parameters import RobotParameters
    from agv_motion.nodes.robot_services import RobotServices
    from agv_motion.ros.live_port import LivePort

    Answer = Callable[[str | Exception], None]

KINEMATICS = 'wheel_kinematics', 'differential_kinematics', 'omni_kinematics'
"""Nodes that drive wheels; their ``~/stop`` stands in where there is no arbiter."""
PAUSES = 'motion_generator', 'sequence', 'route_follower'
"""Nodes that can be told to wait, the first that is there"""
ACTS = frozenset({
    'stop', 'release', 'pause', 'resume', 'home', 'next_goal', 'lock', 'unlock', 'goal', 'pose',
    'mark',
})  # fmt: skip
SECOND = 1_000_000_000


class RobotActs:
    """Does what is asked of any robot; everything in the thread of the node."""

    def __init__(
        self, port: LivePort, services: RobotServices, parameters: RobotParameters
    ) -> None:
        """Ask nothing yet.

        Args:
            port: Of the node.
            services: To call the robots' services by.
            parameters: To set those of the robots by.

        """
        self._port, self._services, self._parameters = port, services, parameters
        self._publishers: dict[tuple[str, type[Any]], Any] = {}
        self._held_past_arbiter: set[str] = set()
        """namespaces whose kinematics were stopped, as their arbiter did not answer"""
        self.clock: Callable[[], int] = port.nanoseconds
        """returns the time of the robots' clock [ns]"""
        self.factor: Callable[[], float] = lambda: 1.0
        """returns how many seconds pass there in one"""

    def prepare(self, robot: str) -> None:
        """Open the topics of a robot, so that who listens has been found when they are needed."""
        self.publisher(String, '/mark')
        for kind, topic in ((TwistStamped, 'cmd_vel/stop'), (TwistStamped, 'cmd_vel/manual'),
                            (PoseStamped, 'goal_pose')):  # fmt: skip
            self.publisher(kind, f'{namespace_of(robot)}/{topic}')

    def begin(self, robot: str, action: str, arguments: dict[str, Any], answer: Answer) -> None:
        """Begin an act; ``answer`` gets the words of the robot, or why it was not done.

        Raises:
            RefusedError: The robot has nobody who does that.

        """
        if action == 'set_parameters':
            node, values = arguments['node'], arguments['values']
            self._parameters.set(robot, node, values, answer)
            return
        if action not in ACTS:
            msg = f"'{action}' is nothing that a robot does"
            raise RefusedError(msg)
        getattr(self, f'_{action}')(namespace_of(robot), arguments, answer)

    def drive(self, robot: str, twist: Twist, age: float) -> None:
        """Publish a twist of a person's hand, stamped with when the hand moved."""
        moment = max(self.clock() - round(age * self.factor() * SECOND), 0)
        self._publish_twist(f'{namespace_of(robot)}/cmd_vel/manual', twist, moment)

    # Acts: each takes namespace, arguments and where the answer goes

    def _stop(self, namespace: str, _: dict[str, Any], answer: Answer) -> None:
        self._hold(namespace, answer, hold=True)

    def _release(self, namespace: str, _: dict[str, Any], answer: Answer) -> None:
        self._hold(namespace, answer, hold=False)

    def _hold(self, namespace: str, answer: Answer, *, hold: bool) -> None:
        """Hold the wheels, or let them go: by the arbiter, or else by the kinematics themselves."""
        if hold:
            self._publish_twist(f'{namespace}/cmd_vel/stop', REST, self.clock())
        arbiter = f'{namespace}/arbiter/stop'
        kinematics = [f'{namespace}/{one}/stop' for one in KINEMATICS]
        nobody = 'nobody there can stop its wheels'
        if not self._services.has(arbiter):
            self._set_bool(kinematics, nobody, answer, data=hold)
            return

        def told(words: str | Exception) -> None:
            """Hold the wheels themselves where the arbiter does not; let them go with it."""
            failed = isinstance(words, Exception)
            there = any(map(self._services.has, kinematics))
            if there and (failed if hold else namespace in self._held_past_arbiter):
                (self._held_past_arbiter.add if hold else self._held_past_arbiter.discard)(
                    namespace
                )
                self._set_bool(kinematics, nobody, answer, data=hold)
            else:
                answer(words)

        self._call(SetBool, arbiter, SetBool.Request(data=hold), told)

    def _pause(self, namespace: str, _: dict[str, Any], answer: Answer) -> None:
        names = [f'{namespace}/{one}/pause' for one in PAUSES]
        self._set_bool(names, 'nobody there can pause it', answer, data=True)

    def _resume(self, namespace: str, _: dict[str, Any], answer: Answer) -> None:
        names = [f'{namespace}/{one}/pause' for one in PAUSES]
        self._set_bool(names, 'nobody there can pause it', answer, data=False)

    def _home(self, namespace: str, _: dict[str, Any], answer: Answer) -> None:
        self._trigger(f'{namespace}/motion_generator/go_home', answer)

    def _next_goal(self, namespace: str, _: dict[str, Any], answer: Answer) -> None:
        self._trigger(f'{namespace}/motion_generator/next_goal', answer)

    def _lock(self, namespace: str, _: dict[str, Any], answer: Answer) -> None:
        names = [f'{namespace}/arbiter/lock_manual']
        self._set_bool(names, 'it has no arbiter, so nobody can be locked out', answer, data=True)

    def _unlock(self, namespace: str, _: dict[str, Any], answer: Answer) -> None:
        names = [f'{namespace}/arbiter/lock_manual']
        self._set_bool(names, 'it has no arbiter, so nobody is locked out', answer, data=False)

    def _goal(self, namespace: str, arguments: dict[str, Any], answer: Answer) -> None:
        publisher = self.publisher(PoseStamped, f'{namespace}/goal_pose')
        if not publisher.get_subscription_count():
            msg = 'nobody there takes a goal'
            raise RefusedError(msg)
        message = PoseStamped()
        message.header.frame_id = 'map'
        message.header.stamp = stamp_of(self.clock())
        fill_pose(message.pose, Pose(arguments['x'], arguments['y'], arguments['heading']))
        publisher.publish(message)
        answer('')

    def _pose(self, namespace: str, arguments: dict[str, Any], answer: Answer) -> None:
        request = SetMap.Request()
        stamped = request.initial_pose
        stamped.header.frame_id = 'map'
        stamped.header.stamp = stamp_of(self.clock())
        fill_pose(stamped.pose.pose, Pose(arguments['x'], arguments['y'], arguments['heading']))
        covariance = stamped.pose.covariance
        covariance[0] = covariance[7] = 0.05**2
        covariance[35] = 0.05**2
        self._call(SetMap, f'{namespace}/localization/set_pose', request, answer)

    def _mark(self, _: str, arguments: dict[str, Any], answer: Answer) -> None:
        """Publish a text for all who record."""
        self.publisher(String, '/mark').publish(String(data=arguments['text']))
        answer('')

    # Plumbing

    def _set_bool(self, names: list[str], nobody: str, answer: Answer, *, data: bool) -> None:
        """Call the first of some services that is there.

        Raises:
            RefusedError: None is.

        """
        name = next((one for one in names if self._services.has(one)), None)
        if name is None:
            raise RefusedError(nobody)
        self._call(SetBool, name, SetBool.Request(data=data), answer)

    def _trigger(self, name: str, answer: Answer) -> None:
        if not self._services.has(name):
            msg = f'{name} is not there'
            raise RefusedError(msg)
        self._call(Trigger, name, Trigger.Request(), answer)

    def _call(self, kind: type[Any], name: str, request: Any, answer: Answer) -> None:
        def told(response: Any) -> None:
            if isinstance(response, Exception):
                answer(response)
            elif response.success:
                answer(str(getattr(response, 'message', '')))
            else:
                answer(RefusedError(str(getattr(response, 'message', '')) or f'{name} refused'))

        self._services.call(kind, name, request, told)

    def _publish_twist(self, topic: str, twist: Twist, moment: int) -> None:
        message = TwistStamped()
        message.header.stamp = stamp_of(moment)
        fill_twist(message.twist, without_minus_zero(twist))
        self.publisher(TwistStamped, topic).publish(message)

    def publisher(self, kind: type[Any], topic: str) -> Any:
        """Return the publisher of a topic, made when it is first needed."""
        key = topic, kind
        if key not in self._publishers:
            self._publishers[key] = self._port.publisher(kind, topic, COMMAND)
        return self._publishers[key]
