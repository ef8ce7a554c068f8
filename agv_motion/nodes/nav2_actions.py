"""Node `nav2_actions`: Nav2's actions in, orders to the nodes that drive out; needs nav2_msgs."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING, Annotated, Any

import rclpy
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor

from agv_motion.client.goal_runner import Ending, GoalRunner
from agv_motion.client.nav2_goals import ACTIONS, allowance_of, fill_duration
from agv_motion.client.robot import Robot
from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check
from agv_motion.ros.context import begin_context
from agv_motion.ros.diagnosis import OK, Diagnosis
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.run import run

if TYPE_CHECKING:
    from agv_motion.client.goal_runner import GoalEnd, GoalProgress
    from agv_motion.client.nav2_goals import Nav2Action
    from agv_motion.ros.live_port import LivePort

THREADS = 8
"""One for each goal that is not over, and some that answer meanwhile."""
MOST_GOALS = 4
SPIN_PERIOD = 0.1
"""[s]"""


@dataclass(frozen=True)
class Nav2ActionsParameters:
    """How long to wait for a robot that has a goal."""

    patience: Annotated[
        float, Spec('time for its nodes to be found, and to answer', 's', (0.1, 600.0))
    ] = 5.0
    silent_after: Annotated[
        float, Spec('silence of the robot after which a goal is aborted', 's', (0.1, 600.0))
    ] = 10.0
    stands_for: Annotated[
        float, Spec('time that it may stand before a goal is aborted', 's', (0.1, 1e6))
    ] = 60.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class Nav2Actions(PlainNode[Nav2ActionsParameters]):
    """`navigate_to_pose`, `follow_path`, `spin`, `drive_on_heading`, over the nodes that drive.

    One goal at a time: the newest. Deactivated it takes the goal back that is under way.
    """

    name = 'nav2_actions'
    takes = Nav2ActionsParameters

    port: LivePort

    def __init__(self, port: LivePort, parameters: Nav2ActionsParameters) -> None:
        """Look for Nav2's messages.

        Raises:
            ConfigurationError: They are not installed.

        """
        super().__init__(port, parameters)
        self._kinds = kinds()
        self._server: GoalServer | None = None

    def begin(self) -> None:
        """Offer the actions."""
        node, given = self.port.node, self.parameters
        domain = node.context.get_domain_id()
        find = partial(
            Robot, self.port.namespace, patience=given.patience,
            silent_after=given.silent_after, stands_for=given.stands_for, domain=domain,
        )  # fmt: skip
        self._server = GoalServer(find, self._kinds, self.port.namespace, domain)

    def halt(self) -> None:
        """Take the goal back, and offer nothing any more."""
        if self._server is not None:
            self._server.close()
            self._server = None

    def diagnose(self) -> Diagnosis:
        """Tell how many goals there are."""
        goals = 0 if self._server is None else self._server.goals
        return Diagnosis(OK, 'at work' if goals else 'waiting for a goal', {'goals': str(goals)})


def kinds() -> dict[str, Any]:
    """Return the class of each action.

    Raises:
        ConfigurationError: nav2_msgs is not installed.

    """
    try:
        found = import_module('nav2_msgs.action')
    except ImportError as error:
        msg = (
            f'nav2_msgs is not there ({error}): it comes with a ROS installation '
            '(apt install ros-jazzy-nav2-msgs, then source its setup.bash); without it use '
            'agv_motion.client'
        )
        raise ConfigurationError(msg) from error
    return {action.name: getattr(found, action.kind) for action in ACTIONS}


class ServedGoal:
    """One goal of a client, as `GoalRunner` wants it."""

    def __init__(self, action: Nav2Action, handle: Any, feedback: Any) -> None:
        """Wrap the handle of a goal, and a message of feedback of its class."""
        self.frame = action.frame(handle.request).lstrip('/')
        self.allowance = allowance_of(handle.request)
        self._action, self._handle, self._feedback = action, handle, feedback

    def order(self, robot: Any) -> None:
        """Give the order."""
        self._action.order(robot, self._handle.request)

    def is_cancel_requested(self) -> bool:
        """Return whether its client wants it no more."""
        return bool(self._handle.is_cancel_requested)

    def tell(self, progress: GoalProgress) -> None:
        """Publish feedback."""
        self._action.fill(self._feedback, progress, self.frame)
        self._handle.publish_feedback(self._feedback)


class GoalServer:
    """The actions of a robot, on a context and threads of their own: a goal takes its time."""

    def __init__(self, find: Any, classes: dict[str, Any], namespace: str, domain: int) -> None:
        """Offer them.

        Args:
            find: Returns the robot; called with the first goal.
            classes: Of each action, by its name.
            namespace: Of the robot.
            domain: ROS domain.

        """
        self._taken: dict[bytes, object] = {}
        """ticket of each goal that is not over, by its id"""
        self._robot: Any = None
        self._find = find
        self._runner = GoalRunner(self._found)
        self._context = rclpy.Context()
        begin_context(args=[], context=self._context, domain_id=domain)
        self._node = rclpy.create_node(
            '_nav2_action_server', namespace=namespace, context=self._context,
            start_parameter_services=False,
        )  # fmt: skip
        group = MutuallyExclusiveCallbackGroup()  # goals are taken one by one, as they came
        self._servers = [
            ActionServer(
                self._node, classes[action.name], action.name,
                partial(self._execute, action, classes[action.name]), callback_group=group,
                goal_callback=self._admit, handle_accepted_callback=self._accepted,
                cancel_callback=lambda _: CancelResponse.ACCEPT,
            )
            for action in ACTIONS
        ]  # fmt: skip
        self._executor = MultiThreadedExecutor(THREADS, context=self._context)
        self._executor.add_node(self._node)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._spin, name='nav2_actions', daemon=True)
        self._thread.start()

    @property
    def goals(self) -> int:
        """That are not over."""
        return len(self._taken)

    def close(self) -> None:
        """Abort the goal that is under way, and leave the graph."""
        self._runner.close()
        self._ended.set()
        self._thread.join()
        self._executor.shutdown()
        if self._robot is not None:
            self._robot.close()
        for server in self._servers:
            server.destroy()
        self._node.destroy_node()
        rclpy.shutdown(context=self._context)

    def _found(self) -> Any:
        self._robot = self._find()
        return self._robot

    def _spin(self) -> None:
        while not self._ended.is_set():
            self._executor.spin_once(timeout_sec=SPIN_PERIOD)

    def _admit(self, _: Any) -> GoalResponse:
        """Take a goal, unless too many wait for the newest to take their place."""
        full = self._ended.is_set() or self.goals >= MOST_GOALS
        return GoalResponse.REJECT if full else GoalResponse.ACCEPT

    def _accepted(self, handle: Any) -> None:
        """Make it the newest at once: threads may begin what they execute in another order."""
        self._taken[bytes(handle.goal_id.uuid)] = self._runner.admit()
        handle.execute()

    def _execute(self, action: Nav2Action, kind: Any, handle: Any) -> Any:
        number = bytes(handle.goal_id.uuid)
        try:
            end = self._runner.run(ServedGoal(action, handle, kind.Feedback()), self._taken[number])
        finally:
            del self._taken[number]
        self._node.get_logger().info(f'{action.name}: {end.ending.value}: {end.reason}')
        _finish(handle, end.ending)
        return _result(kind.Result(), action, end)


def _finish(handle: Any, ending: Ending) -> None:
    if ending is Ending.SUCCEEDED:
        handle.succeed()
    elif ending is Ending.CANCELED:
        handle.canceled()
    else:
        handle.abort()


def _result(result: Any, action: Nav2Action, end: GoalEnd) -> Any:
    result.error_code = action.codes[end.error]
    if hasattr(result, 'error_msg'):  # the first releases for Jazzy have none
        result.error_msg = end.reason
    if hasattr(result, 'total_elapsed_time'):
        fill_duration(result.total_elapsed_time, end.seconds)
    return result


def main() -> None:
    """Run the node."""
    run(Nav2Actions)


if __name__ == '__main__':
    main()
