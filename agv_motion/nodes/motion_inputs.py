"""What `motion_generator` hears: sap flow, whether that can be believed, and the pose."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.activity import Activity, Cause, Doing
from agv_motion.motion.behavior.sap_flow import SapFlow, checked_sap_flow
from agv_motion.nodes.motion_report import missing
from agv_motion.ros.input_watches import InputWatches
from agv_motion.ros.messages import pose_of, require_frame
from agv_motion.watchdog import Silence

if TYPE_CHECKING:
    from geometry_msgs.msg import PoseWithCovarianceStamped, Vector3Stamped

    from agv_motion.nodes.motion_parameters import MotionGeneratorParameters
    from agv_motion.planar import Pose
    from agv_motion.ros.port import Port

FLOW, POSE = 'sap flow', 'pose'
"""The inputs without which the tree does not move."""


class MotionInputs:
    """The last of each input, and whether it still counts."""

    def __init__(self, port: Port, given: MotionGeneratorParameters) -> None:
        """Know nothing."""
        self._port, self._given = port, given
        self.flow: SapFlow | None = None
        self.pose: Pose | None = None
        self.valid = True
        """Whether all probes can be believed"""
        self.watches = InputWatches(port, given.freshness(), (FLOW, POSE))

    def begin(self) -> None:
        """Know nothing of before."""
        self.flow = self.pose = None
        self.watches.wait_for(FLOW)

    @property
    def pose_now(self) -> Pose | None:
        """Where the tree is; None while its pose is lost."""
        return None if self.watches[POSE].silence() is Silence.LOST else self.pose

    def take_flow(self, message: Vector3Stamped) -> bool:
        """Take a sap flow; return whether it is news.

        Raises:
            AgvMotionError: It is none, or of another robot.

        """
        vector = message.vector
        flow = checked_sap_flow(SapFlow(vector.x, vector.y, vector.z))
        require_frame(self._given.own(message.header.frame_id), self._given.base_frame)
        if not self.watches[FLOW].is_news(message.header.stamp):
            return False
        self.watches.note(FLOW)
        self.flow = flow
        return True

    def take_pose(self, message: PoseWithCovarianceStamped) -> bool:
        """Take a pose; return whether it is news.

        Raises:
            AgvMotionError: It is none, or in another frame than the map.

        """
        require_frame(message.header.frame_id, self._given.map_frame)
        pose = pose_of(message.pose.pose)
        if not self.watches[POSE].is_news(message.header.stamp):
            return False
        self.watches.note(POSE)
        self.pose = pose
        return True

    def obstacle(self) -> Doing | None:
        """Return what the tree does for want of an input; None if it wants none."""
        if not self.valid:
            return Doing('resting: a probe cannot be believed', Activity.RESTING, Cause.PROBES)
        if self.watches.lost or self.flow is None or self.pose is None:
            return missing(self.pose, self.flow, self.watches.lost, self._port.clock.fault)
        return None
