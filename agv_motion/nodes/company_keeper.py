"""What `motion_generator` does for a tree among others: tells its claims, and hears theirs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.qos import QoSProfile
from visualization_msgs.msg import MarkerArray

from agv_motion.errors import ConfigurationError
from agv_motion.motion.paths import Paths
from agv_motion.motion.traffic.company import Company
from agv_motion.motion.traffic.right_of_way import RightOfWay
from agv_motion.motion.traffic.traffic import Traffic
from agv_motion.ros.claims import claim_message, claim_of

if TYPE_CHECKING:
    from agv_motion.motion.generator import SapFlow
    from agv_motion.motion.mind import Mind
    from agv_motion.motion.thought import Thought
    from agv_motion.motion.traffic.parameters import TrafficParameters
    from agv_motion.planar import Pose
    from agv_motion.ros.node import ManagedNode

WAYS = QoSProfile(depth=50)
"""All trees speak on one topic; none of their words may be dropped for another's."""

TELL_EVERY = 1.0
"""[s] between two claims, unless there is something new to ask."""


class CompanyKeeper:
    """Joins the mind of a node to the other trees on `/ways`, once the tree knows where it is."""

    def __init__(
        self,
        node: ManagedNode[Any],
        mind: Mind,
        parameters: TrafficParameters,
        name: str,
        frame: str,
    ) -> None:
        """Open the topic.

        Args:
            node: Which needs the company.
            mind: Its mind, in a zone.
            parameters: How trees share the zone.
            name: Of this tree, different from every other's.
            frame: Of the map.

        Raises:
            ConfigurationError: There is no zone to share, or the tree has no name.

        """
        if mind.zone is None:
            msg = 'share_zone without a zone: give zone_file'
            raise ConfigurationError(msg)
        if not name:
            msg = 'share_zone without a name: start the node in a namespace, or give tree_name'
            raise ConfigurationError(msg)
        self._node, self._mind, self._parameters = node, mind, parameters
        self._zone, self._paths = mind.zone, Paths(mind.zone)
        self._name, self._frame = name, frame
        self._company: Company | None = None
        self._told: object = None
        self._told_at = 0.0
        self._publisher = node.publisher(MarkerArray, '/ways', WAYS)
        node.listen(MarkerArray, '/ways', self._on_claim, WAYS)

    def think(self, now: float, pose: Pose, flow: SapFlow) -> Thought:
        """Return what to do, as far as the others let the tree; see :meth:`Company.think`."""
        thought = self._joined(pose).think(now, pose, flow)
        self._tell(now)
        return thought

    def stay(self, now: float, pose: Pose) -> None:
        """Hold the place where the tree stands, and tell so."""
        self._joined(pose).traffic.rest((pose.x, pose.y))
        self._tell(now)

    def park(self, now: float, pose: Pose) -> None:
        """Say at the end that the tree stays here: nobody needs to wait for its answer."""
        traffic = self._joined(pose).traffic
        traffic.park((pose.x, pose.y))
        self._publisher.publish(claim_message(traffic.claim(now), self._frame))

    def report(self) -> dict[str, str]:
        """Return who else is there, for the diagnostics."""
        if self._company is None:
            return {'other trees': 'not known: no pose yet'}
        peers = self._company.traffic.right.peers
        told = [f'{p.claim.name}{" (silent)" if p.silent else ""}' for p in peers]
        return {'other trees': ', '.join(told) or 'none heard'}

    def _joined(self, pose: Pose) -> Company:
        if self._company is None:
            right = RightOfWay(self._name, (pose.x, pose.y), self._parameters)
            self._company = Company(self._mind, Traffic(right, self._zone, self._paths))
        return self._company

    def _tell(self, now: float) -> None:
        """Tell the others once a second, and at once what is newly asked for."""
        if self._company is None:
            return
        traffic = self._company.traffic
        if traffic.right.asked is self._told and 0.0 <= now - self._told_at < TELL_EVERY:
            return
        self._told, self._told_at = traffic.right.asked, now
        self._publisher.publish(claim_message(traffic.claim(now), self._frame))

    def _on_claim(self, message: MarkerArray) -> None:
        claim = claim_of(message, self._frame)
        if self._company is not None:
            self._company.traffic.hear(claim, self._node.seconds())
