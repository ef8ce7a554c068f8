"""What `motion_generator` tells of a tree: `state`, `goal` and `path`, where they have changed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path
from std_msgs.msg import String

from agv_motion.activity import Activity, Cause, Doing
from agv_motion.nodes.state_report import StateReport
from agv_motion.planar import Pose
from agv_motion.ros.messages import fill_path, fill_pose
from agv_motion.ros.qos import LATCHED

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.motion.behavior.goals.goal import Goal
    from agv_motion.motion.behavior.sap_flow import SapFlow
    from agv_motion.motion.behavior.schedule import Hour
    from agv_motion.motion.navigation.polyline import Path as Corners
    from agv_motion.ros.port import Port


class MotionReport:
    """The latched topics of one tree."""

    def __init__(self, port: Port, frame: str) -> None:
        """Open the topics.

        Args:
            port: Of the node.
            frame: Of the map.

        """
        self._losses = ''
        self._port, self._frame = port, frame
        self._goal: Goal | None = None
        self._path: Corners = ()
        self._paths = port.publisher(Path, 'path', LATCHED, sole=True)
        self._goals = port.publisher(PoseStamped, 'goal', LATCHED)
        self._states = StateReport(port, 'state')
        port.listen(String, 'granier/state', self._take_losses, LATCHED)

    @property
    def state(self) -> str:
        """What the tree does, in words, as it was told last."""
        return self._states.state

    def _take_losses(self, message: String) -> None:
        """Know which probes are lost and what stands in for them: that is told beside the rest."""
        self._losses = message.data

    def publish_state(self, doing: Doing) -> None:
        """Tell what the tree does, if that is new."""
        if self._losses:
            doing = doing._replace(state=f'{doing.state}; {self._losses}')
        self._states.update(doing)

    def values(self, hour: Hour, time_zone: str) -> dict[str, str]:
        """Return what the tree does, for programs that read the diagnostics."""
        return self._states.values() | {
            'waits for': self._states.doing.waits_for,
            'hours': hour.phase.name.lower(),
            'hours until [s]': f'{hour.until:.0f}',
            'time zone': time_zone,
        }

    def update(self, goal: Goal | None, refusals: Sequence[str], path: Corners) -> None:
        """Tell goal and path, each if it is new."""
        if goal is not self._goal:
            self.publish_goal(goal, refusals)
        if path[1:] != self._path[1:]:
            self._publish_path(path)

    def publish_goal(self, goal: Goal | None, refusals: Sequence[str]) -> None:
        """Publish and log a goal with its reason, and why others were not taken."""
        self._goal = goal
        for refusal in refusals:
            self._port.info(f'no goal: {refusal}')
        if goal is None:
            return
        self._port.info(f'goal: {goal.reason}')
        message = PoseStamped()
        self._port.stamp(message)
        message.header.frame_id = self._frame
        fill_pose(message.pose, Pose(*goal.place, 0.0))
        self._goals.publish(message)

    def _publish_path(self, path: Corners) -> None:
        self._path = path
        message = Path()
        message.header.frame_id = self._frame
        self._port.stamp(message)
        fill_path(message, [Pose(x, y, 0.0) for x, y in path])
        self._paths.publish(message)


def missing(pose: Pose | None, flow: SapFlow | None, lost: str = '', fault: str = '') -> Doing:
    """Return what a tree does without an input; at the start it has only to wait for it.

    Args:
        pose: None: not told yet.
        flow: None: not told yet.
        lost: Which input is lost; empty if none is.
        fault: Why the clock cannot be believed; empty if it can.

    """
    state = f'resting: {fault or "no " + (lost or "input")}'
    if fault:
        return Doing(state, Activity.STOPPED, Cause.CLOCK)
    without_pose = lost == 'pose' if lost else pose is None and flow is not None
    known = pose is not None and flow is not None
    return Doing(
        state,
        Activity.STOPPED if known else Activity.STARTING,
        Cause.POSE if without_pose else Cause.SAP_FLOW,
    )
