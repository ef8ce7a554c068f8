"""What `motion_generator` does for a tree among others: its reservations out, theirs in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.qos import QoSProfile
from visualization_msgs.msg import MarkerArray

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.motion.navigation.reservations.lived_time import LivedTime
from agv_motion.motion.navigation.reservations.right_of_way import RightOfWay
from agv_motion.motion.navigation.reservations.roster import Roster
from agv_motion.motion.navigation.reservations.shared_navigator import SharedNavigator
from agv_motion.motion.pilot import Pilot
from agv_motion.ros.reservations import reservation_message, reservation_of

if TYPE_CHECKING:
    from agv_motion.motion.behavior.agent import Agent
    from agv_motion.motion.behavior.sap_flow import SapFlow
    from agv_motion.motion.navigation.zone import Zone
    from agv_motion.motion.pilot import MotionCommand
    from agv_motion.nodes.motion_parameters import MotionGeneratorParameters
    from agv_motion.planar import Pose
    from agv_motion.ros.port import Port

WAYS = QoSProfile(depth=50)
"""All trees speak on one topic; none of their words may be dropped for another's."""

PUBLISH_EVERY = 1.0
"""[s] between two reservations, unless there is something new to request."""


class ReservationExchange:
    """Joins a node to the other trees on `/reservations`, once the tree knows where it is."""

    def __init__(
        self, port: Port, agent: Agent, given: MotionGeneratorParameters, name: str
    ) -> None:
        """Open the topic.

        Args:
            port: Of the node.
            agent: What decides, in a zone.
            given: How trees share the zone, and where their names are kept over a restart.
            name: Of this tree, different from every other's.

        Raises:
            ConfigurationError: There is no zone to share, the tree has no name, or knows of nobody
                to share it with.

        """
        if agent.planner is None:
            msg = 'share_zone without a zone: give zone_file'
            raise ConfigurationError(msg)
        if not name:
            msg = 'share_zone without a name: start the node in a namespace, or give tree_name'
            raise ConfigurationError(msg)
        parameters, peers_file = given.sharing(), given.peers_file
        self._roster = Roster(peers_file)
        if self._roster.complaint:
            port.error(self._roster.complaint)
        if not {*parameters.expected, *self._roster.names} - {name}:
            where = f"peers_file '{peers_file}' remembers" if peers_file else 'no peers_file tells'
            msg = (
                f'share_zone knows no other tree ({where} none): name all others in '
                'traffic.expected, else this one would walk into any that it does not hear yet'
            )
            raise ConfigurationError(msg)
        self._port, self._agent, self._parameters = port, agent, parameters
        self._planner = agent.planner
        self._name, self._frame = name, given.map_frame
        self._lived = LivedTime(max(PUBLISH_EVERY, 2.0 / given.rate))
        self._simulated = port.is_simulated
        self._navigator: SharedNavigator | None = None
        self._pilot: Pilot | None = None
        self._published: object = None
        self._published_at = -PUBLISH_EVERY
        self._publisher = port.publisher(MarkerArray, '/reservations', WAYS)
        port.listen(MarkerArray, '/reservations', self._on_reservation, WAYS)

    def update(self, time: float, pose: Pose, flow: SapFlow) -> MotionCommand:
        """Return how to move, as far as the others let the tree; see :meth:`Pilot.update`."""
        now, navigator = self._now(), self._joined(pose)
        if self._pilot is None:
            self._pilot = Pilot(self._agent, navigator)
        motion = self._pilot.update(time, pose, flow, now)
        self._publish_if_due(now)
        return motion

    def stay(self, pose: Pose, *, fresh: bool) -> None:
        """Hold the place where the tree stands, and tell so.

        Args:
            pose: Where it is, as far as is known.
            fresh: Whether all inputs still come; else nothing grows surer.

        """
        now = self._now()
        self._joined(pose).rest((pose.x, pose.y), now, fresh=fresh)
        self._publish_if_due(now)

    @property
    def others(self) -> list[str]:
        """Names of the trees that were told or ever heard."""
        return sorted({*self._parameters.expected, *self._roster.names} - {self._name})

    def require_inside(self, zone: Zone) -> None:
        """Raise where another tree stands that a zone leaves out; one that is off may be a hole.

        Raises:
            ConfigurationError: One stands there.

        """
        peers = () if self._navigator is None else self._navigator.right.peers
        for peer in peers:
            told = peer.reservation
            if not (peer.silent or told.parked or zone.contains(*told.held[0])):
                x, y = told.held[0]
                msg = (
                    f'zone: {told.name} stands at ({x:.2f}, {y:.2f}), which '
                    f'{zone.why_not(x, y)}: let it walk in first, or draw the zone round it'
                )
                raise ConfigurationError(msg)

    def move_to(self, agent: Agent, pose: Pose) -> None:
        """Go on as ``agent``, in the zone that it knows.

        The tree lets go of all floor but where it stands, as it may at any time, and asks anew for
        what a path through the other zone needs. What it knows of the others stays.

        Raises:
            ConfigurationError: The agent has no zone.

        """
        if agent.planner is None:
            msg = 'zone: a zone that is shared can only be replaced by another'
            raise ConfigurationError(msg)
        self.stay(pose, fresh=True)
        self._agent, self._planner, self._pilot = agent, agent.planner, None
        if self._navigator is not None:
            self._navigator = SharedNavigator(self._navigator.right, self._planner)

    def park(self, pose: Pose) -> None:
        """Say at the end that the tree stays here: nobody needs to wait for its answer."""
        now = self._now()
        self._joined(pose).park((pose.x, pose.y), now)
        self._publish(now)

    def report(self) -> dict[str, str]:
        """Return who else is there, and what is wrong with them, for the diagnostics."""
        if self._navigator is None:
            return {'other trees': 'not known: no pose yet', 'nobody moves': 'no'}
        right = self._navigator.right
        told = [f'{p.reservation.name}{" (silent)" if p.silent else ""}' for p in right.peers]
        told += [f'{name} (never heard)' for name in right.awaited if name not in right.peers]
        return {
            'other trees': ', '.join(told) or 'none heard',
            'nobody moves': right.obstacle(self._lived.seconds) or 'no',
        }

    @property
    def alarm(self) -> str:
        """Why this tree must not move whatever it holds, in words; empty if it may."""
        return '' if self._navigator is None else self._navigator.right.obstacle(self._now())

    def _now(self) -> float:
        """Return the time this tree has lived through [s]; see :class:`LivedTime`.

        The steady clock always counts, and a simulated one where it goes faster: then trees too do.
        """
        port = self._port
        simulated = [port.seconds()] if self._simulated else []
        return self._lived.update(port.steady_seconds(), *simulated)

    def _joined(self, pose: Pose) -> SharedNavigator:
        """Return what takes the tree among the others, once it knows where it stands."""
        if self._navigator is None:
            place, known = (pose.x, pose.y), self._roster.names
            right = RightOfWay(self._name, place, self._parameters, known=known)
            self._navigator = SharedNavigator(right, self._planner)
        return self._navigator

    def _publish_if_due(self, now: float) -> None:
        """Tell the others once a second, and at once what is newly requested."""
        if self._navigator is None:
            return
        news = self._navigator.right.requested is not self._published
        if news or now - self._published_at >= PUBLISH_EVERY:
            self._publish(now)

    def _publish(self, now: float) -> None:
        assert self._navigator is not None
        self._published, self._published_at = self._navigator.right.requested, now
        reservation = self._navigator.reservation(now)
        message = reservation_message(reservation, self._frame, self._port.nanoseconds())
        self._publisher.publish(message)

    def _on_reservation(self, message: MarkerArray) -> None:
        """Take up what another tree says; what cannot be understood stops this one for a while.

        Raises:
            SignalError: It cannot be understood, or bears the name of this tree.

        """
        if self._navigator is None:
            return
        right, now = self._navigator.right, self._now()
        try:
            reservation = reservation_of(message, self._frame)
        except SignalError as error:
            right.alarm(f'a reservation was refused: {error}', now)
            raise
        if self._port.is_recorded and reservation.name == self._name:
            return  # what this tree said when it was recorded: no other calls itself so
        right.receive(reservation, now)
        if reservation.name != self._name:
            try:  # before this tree tells it that it was heard
                self._roster.add(reservation.name)
            except ConfigurationError as error:
                self._port.refuse(str(error))
