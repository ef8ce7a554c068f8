"""`agv drive` for real: ask the node ghost_trajectory on the graph, and watch the robot go."""

from __future__ import annotations

import time
from contextlib import contextmanager
from math import hypot
from typing import TYPE_CHECKING, Any

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, Vector3Stamped
from nav_msgs.msg import Path
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.parameter import Parameter, parameter_value_to_python
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
from std_msgs.msg import String
from std_srvs.srv import Trigger

from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.ros.context import begin_context
from agv_motion.ros.messages import fill_pose
from agv_motion.ros.qos import COMMAND, LATCHED
from agv_motion.ros.stop import Stop

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rich.console import Console

    from agv_motion.cli.robot.drive_goal import DriveGoal

PATIENCE = 5.0
"""[s] For the node to be found, and for each of its answers."""

LATCHED_TIME = 0.5
"""[s] In which what was latched before comes in."""

LONGEST_BRAKING = 10.0
"""[s] After Ctrl-C the robot brakes; no longer is waited for it."""

ENDS = ('arrived', 'aborted', 'lost', 'not arrived')
"""How a drive ends, as `ghost/state` begins then."""


class GhostNews:
    """What the node tells of a drive."""

    def __init__(self, name: str) -> None:
        """Know nothing yet of the node ``name``."""
        self.name = name
        self.state = ''
        self.refusal = ''
        self.reports: list[str] = []
        self.way: list[tuple[float, float]] = []
        self.passed = 0
        """Places of the way that the Ghost has left behind"""

    def begin(self) -> None:
        """Forget what was told of an earlier goal."""
        self.state = ''
        self.reports.clear()

    def take_state(self, message: String) -> None:
        """Take what the robot does."""
        self.state = message.data

    def take_report(self, message: String) -> None:
        """Take what a goal asks for."""
        self.reports.append(message.data)

    def take_path(self, message: Path) -> None:
        """Take the way that the Ghost goes."""
        self.way = [(p.pose.position.x, p.pose.position.y) for p in message.poses]
        self.passed = 0

    def take_ghost(self, message: PoseStamped) -> None:
        """Find how far on its way the Ghost is; it only goes on."""
        here = message.pose.position
        ahead = self.way[self.passed :]
        if ahead:
            distances = [hypot(here.x - x, here.y - y) for x, y in ahead[:40]]
            self.passed += distances.index(min(distances))

    def take_diagnostics(self, message: DiagnosticArray) -> None:
        """Take why a goal is refused."""
        for status in message.status:
            if status.name == self.name and 'refused' in status.message:
                self.refusal = status.message


class DriveOrders:
    """One goal, from the question to the end of the drive."""

    def __init__(self, namespace: str) -> None:
        """Talk to the node in ``namespace``."""
        self._prefix = f'/{namespace.strip("/")}/' if namespace.strip('/') else '/'
        self._news = GhostNews(f'{self._prefix}ghost_trajectory')

    def run(self, goal: DriveGoal, speed: float | None, console: Console) -> bool:
        """Drive to ``goal``; return whether the robot has arrived.

        Raises:
            SourceError: The node is not there, or does not answer.
            ConfigurationError: It refuses the goal; the message says why.

        """
        begin_context()
        self._stop = Stop()
        self._node = rclpy.create_node('_agv_drive', start_parameter_services=False)
        try:
            publisher = self._join(goal)
            with self._changed(goal.changes):
                publisher.publish(self._message(goal, speed))
                self._await_answer()
            for line in self._news.reports[-1].splitlines():
                console.print(line, highlight=False)
            self._watch(console)
            return self._news.state.startswith('arrived')
        finally:
            self._node.destroy_node()
            rclpy.try_shutdown()

    def _join(self, goal: DriveGoal) -> Any:
        """Find the node, and hear what it has told before."""
        node, prefix = self._node, self._prefix
        kind, topic = (Vector3Stamped, 'arc') if goal.arc else (
            (Path, 'path') if len(goal.poses) > 1 else (PoseStamped, 'goal_pose')
        )  # fmt: skip
        publisher = node.create_publisher(kind, prefix + topic, COMMAND)
        news, name = self._news, self._news.name
        self._service = {
            kind: node.create_client(kind, f'{name}/{service}')
            for kind, service in (
                (Trigger, 'abort'),
                (GetParameters, 'get_parameters'),
                (SetParameters, 'set_parameters'),
            )
        }
        ready = self._service[Trigger].service_is_ready
        if not self._until(lambda: ready() and publisher.get_subscription_count() > 0):
            msg = (
                f'no node {name} that listens: start it (agv run ghost_trajectory), activate it, '
                'or name its --namespace'
            )
            raise SourceError(msg)
        node.create_subscription(String, f'{prefix}ghost/state', news.take_state, LATCHED)
        node.create_subscription(Path, f'{prefix}ghost/path', news.take_path, LATCHED)
        node.create_subscription(String, f'{prefix}ghost/report', news.take_report, LATCHED)
        node.create_subscription(PoseStamped, f'{prefix}ghost/pose', news.take_ghost, COMMAND)
        node.create_subscription(DiagnosticArray, '/diagnostics', news.take_diagnostics, 10)
        self._until(lambda: False, LATCHED_TIME)
        news.begin()
        return publisher

    def _message(self, goal: DriveGoal, speed: float | None) -> Any:
        """Return the goal as a message, in the frame in which the node drives."""
        frame, cruising = self._parameters(['frame', 'cruising_speed'])
        if goal.arc:
            arc = Vector3Stamped()
            arc.vector.x, arc.vector.y = goal.arc
            arc.vector.z = cruising if speed is None else speed
            return arc
        poses = []
        for pose in goal.poses:
            message = PoseStamped()
            message.header.frame_id = frame
            fill_pose(message.pose, pose)
            poses.append(message)
        if len(poses) == 1:
            return poses[0]
        path = Path(poses=poses)
        path.header.frame_id = frame
        return path

    @contextmanager
    def _changed(self, changes: dict[str, float | bool]) -> Iterator[None]:
        """Set parameters of the node for this goal alone."""
        if not changes:
            yield
            return
        before = dict(zip(changes, self._parameters(list(changes)), strict=True))
        self._set(changes)
        try:
            yield
        finally:
            self._set(before)

    def _await_answer(self) -> None:
        """Wait until the node tells what the goal asks for, or why it is refused."""
        news = self._news
        news.refusal = ''
        self._until(lambda: bool(news.reports or news.refusal))
        if not news.reports:
            msg = news.refusal or 'ghost_trajectory does not answer: look at /diagnostics'
            raise ConfigurationError(msg)

    def _watch(self, console: Console) -> None:
        """Show the drive until its end; Ctrl-C brakes the robot."""
        columns = TextColumn('{task.description}', markup=False), BarColumn(), TimeElapsedColumn()
        braking_since = None
        with Progress(*columns, console=console, disable=not console.is_terminal) as progress:
            task = progress.add_task('', total=max(len(self._news.way) - 1, 1))
            told = ''
            while not self._news.state.startswith(ENDS):
                rclpy.spin_once(self._node, timeout_sec=0.1)
                progress.update(task, description=self._news.state, completed=self._news.passed)
                if progress.disable and self._news.state != told:
                    told = self._news.state
                    console.print(told, highlight=False)
                if self._stop.requested and braking_since is None:
                    braking_since = time.monotonic()
                    self._service[Trigger].call_async(Trigger.Request())
                if braking_since and time.monotonic() - braking_since > LONGEST_BRAKING:
                    msg = f'the robot does not say that it stands: {self._news.state}'
                    raise SourceError(msg)
        if self._news.state != told:
            console.print(self._news.state, highlight=False)

    # Services

    def _parameters(self, names: list[str]) -> list[Any]:
        answer = self._ask(GetParameters, GetParameters.Request(names=names))
        return [parameter_value_to_python(value) for value in answer.values]

    def _set(self, values: dict[str, Any]) -> None:
        parameters = [
            Parameter(name, value=value).to_parameter_msg() for name, value in values.items()
        ]
        answer = self._ask(SetParameters, SetParameters.Request(parameters=parameters))
        for name, result in zip(values, answer.results, strict=True):
            if not result.successful:
                msg = f'{name} = {values[name]}: {result.reason}'
                raise ConfigurationError(msg)

    def _ask(self, kind: Any, request: Any) -> Any:
        future = self._service[kind].call_async(request)
        if not self._until(future.done):
            msg = f'{self._news.name} does not answer; is it busy, or stopped?'
            raise SourceError(msg)
        return future.result()

    def _until(self, condition: Callable[[], bool], timeout: float = PATIENCE) -> bool:
        """Spin until ``condition()``; return whether it came true in time."""
        end = time.monotonic() + timeout
        while not condition():
            if time.monotonic() > end or self._stop.requested:
                return False
            rclpy.spin_once(self._node, timeout_sec=0.05)
        return True
