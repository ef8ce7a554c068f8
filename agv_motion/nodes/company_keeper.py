"""What `motion_generator` does for a tree among others: tells its claims, and hears theirs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.qos import QoSProfile
from visualization_msgs.msg import MarkerArray

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.motion.paths import Paths
from agv_motion.motion.traffic.company import Company
from agv_motion.motion.traffic.lived_time import LivedTime
from agv_motion.motion.traffic.right_of_way import RightOfWay
from agv_motion.motion.traffic.roster import Roster
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
        peers_file: str,
    ) -> None:
        """Open the topic.

        Args:
            node: Which needs the company.
            mind: Its mind, in a zone.
            parameters: How trees share the zone.
            name: Of this tree, different from every other's.
            peers_file: Where the names of the others are kept over a restart; empty: nowhere.

        Raises:
            ConfigurationError: There is no zone to share, the tree has no name, or knows of nobody
                to share it with.

        """
        if mind.zone is None:
            msg = 'share_zone without a zone: give zone_file'
            raise ConfigurationError(msg)
        if not name:
            msg = 'share_zone without a name: start the node in a namespace, or give tree_name'
            raise ConfigurationError(msg)
        self._roster = Roster(peers_file)
        if self._roster.complaint:
            node.get_logger().error(self._roster.complaint)
        if not {*parameters.expected, *self._roster.names} - {name}:
            where = f"peers_file '{peers_file}' remembers" if peers_file else 'no peers_file tells'
            msg = (
                f'share_zone knows no other tree ({where} none): name all others in '
                'traffic.expected, else this one would walk into any that it does not hear yet'
            )
            raise ConfigurationError(msg)
        self._node, self._mind, self._parameters = node, mind, parameters
        self._zone, self._paths = mind.zone, Paths(mind.zone)
        self._name, self._frame = name, node.parameters.map_frame
        self._lived = LivedTime(max(TELL_EVERY, 2.0 / node.parameters.rate))
        self._simulated = bool(node.get_parameter('use_sim_time').value)
        self._company: Company | None = None
        self._told: object = None
        self._told_at = -TELL_EVERY
        self._publisher = node.publisher(MarkerArray, '/ways', WAYS)
        node.listen(MarkerArray, '/ways', self._on_claim, WAYS)

    def think(self, time: float, pose: Pose, flow: SapFlow) -> Thought:
        """Return what to do, as far as the others let the tree; see :meth:`Company.think`."""
        now = self._now()
        thought = self._joined(pose).think(time, pose, flow, now)
        self._tell(now)
        return thought

    def stay(self, pose: Pose, *, fresh: bool) -> None:
        """Hold the place where the tree stands, and tell so.

        Args:
            pose: Where it is, as far as is known.
            fresh: Whether all inputs still come; else nothing grows surer.

        """
        now = self._now()
        self._joined(pose).traffic.rest((pose.x, pose.y), now, fresh=fresh)
        self._tell(now)

    def park(self, pose: Pose) -> None:
        """Say at the end that the tree stays here: nobody needs to wait for its answer."""
        now, traffic = self._now(), self._joined(pose).traffic
        traffic.park((pose.x, pose.y), now)
        self._publish(now)

    def report(self) -> dict[str, str]:
        """Return who else is there, and what is wrong with them, for the diagnostics."""
        if self._company is None:
            return {'other trees': 'not known: no pose yet', 'nobody moves': 'no'}
        right = self._company.traffic.right
        told = [f'{p.claim.name}{" (silent)" if p.silent else ""}' for p in right.peers]
        told += [f'{name} (never heard)' for name in right.awaited if name not in right.peers]
        return {
            'other trees': ', '.join(told) or 'none heard',
            'nobody moves': right.obstacle(self._lived.seconds) or 'no',
        }

    @property
    def alarm(self) -> str:
        """Why this tree must not move whatever it holds, in words; empty if it may."""
        return '' if self._company is None else self._company.traffic.right.obstacle(self._now())

    def _now(self) -> float:
        """Return the time this tree has lived through [s]; see :class:`LivedTime`.

        The steady clock always counts, and a simulated one where it goes faster: then trees too do.
        """
        node = self._node
        simulated = [node.seconds()] if self._simulated else []
        return self._lived.update(node.steady_seconds(), *simulated)

    def _joined(self, pose: Pose) -> Company:
        if self._company is None:
            right = RightOfWay(
                self._name, (pose.x, pose.y), self._parameters, known=self._roster.names
            )
            self._company = Company(self._mind, Traffic(right, self._zone, self._paths))
        return self._company

    def _tell(self, now: float) -> None:
        """Tell the others once a second, and at once what is newly asked for."""
        if self._company is None:
            return
        if self._company.traffic.right.asked is self._told and now - self._told_at < TELL_EVERY:
            return
        self._publish(now)

    def _publish(self, now: float) -> None:
        assert self._company is not None
        traffic = self._company.traffic
        self._told, self._told_at = traffic.right.asked, now
        message = claim_message(traffic.claim(now), self._frame, self._node.seconds())
        self._publisher.publish(message)

    def _on_claim(self, message: MarkerArray) -> None:
        """Take up what another tree says; what cannot be understood stops this one for a while.

        Raises:
            SignalError: It cannot be understood, or bears the name of this tree.

        """
        if self._company is None:
            return
        right, now = self._company.traffic.right, self._now()
        try:
            claim = claim_of(message, self._frame)
        except SignalError as error:
            right.alarm(f'a claim was refused: {error}', now)
            raise
        right.hear(claim, now)
        if claim.name != self._name:
            try:  # before this tree tells it that it was heard
                self._roster.add(claim.name)
            except ConfigurationError as error:
                self._node.refuse(str(error))
