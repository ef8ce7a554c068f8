r"""The route follower: from the pose of a robot to its speed and turn rate.

Its speed is that of :mod:`agv_motion.route.speeds`, with dphi the angle from the heading to the
virtual point, dn the way from there to the next waypoint, alpha the angle between its segment and
the next, and d the route still to go: from the robot straight to the virtual point, and on along
the route. Arrived when the virtual point is on the last segment and v(d) = 0. Speed and turn rate
are coupled, from the start and anew at every segment that the virtual point enters.
"""

from __future__ import annotations

from math import atan2, copysign, cos, hypot, isfinite, sin
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import SignalError
from agv_motion.planar import REST, Pose, Twist, require_finite, wrap
from agv_motion.route.coupling import Coupling, CouplingForm
from agv_motion.route.speeds import RouteLimiter, route_speeds
from agv_motion.route.virtual_point import VirtualPoint

if TYPE_CHECKING:
    from agv_motion.route.parameters import FollowParameters
    from agv_motion.route.route import Point, Route


class RouteLimits(NamedTuple):
    """The measures of one step, the speed that each allows, and which is in force."""

    to_go: float
    """d [m]"""
    heading_error: float
    """dphi [rad], positive to the left"""
    to_waypoint: float
    """dn [m]"""
    bend: float
    """alpha [rad]"""
    v_d: float
    """[m/s]"""
    v_dphi: float
    """[m/s]"""
    v_dn: float
    """[m/s]"""
    v_alpha: float
    """[m/s]"""
    speed: float
    """V [m/s]"""
    limiter: RouteLimiter


class RouteStep(NamedTuple):
    """What the follower says at one moment."""

    twist: Twist
    """in the robot's frame"""
    virtual_point: Point
    limits: RouteLimits
    arrived: bool


class RouteFollower:
    """Follows one route once; a new route or a restart is a new follower."""

    def __init__(
        self,
        route: Route,
        parameters: FollowParameters,
        speed: float = 0.0,
        turn_rate: float = 0.0,
    ) -> None:
        """Stand before the start of ``route``.

        Args:
            route: What to follow.
            parameters: How.
            speed: Commanded so far [m/s]: the coupling goes on from it.
            turn_rate: Commanded so far [rad/s].

        Raises:
            ConfigurationError: The distance of the virtual point is too large for the route.

        """
        self.route = route
        self._virtual = VirtualPoint(route, parameters.virtual_point_distance)
        self._speed, self._turn = Coupling(output=speed), Coupling(output=turn_rate)
        self.retune(parameters)
        self.arrived = False

    @property
    def segment(self) -> int:
        """Number of the segment on which the virtual point is, over all laps, from 0."""
        return self._virtual.place.segment

    @property
    def speed(self) -> float:
        """Speed commanded last [m/s]."""
        return self._speed.output

    @property
    def turn_rate(self) -> float:
        """Turn rate commanded last [rad/s]."""
        return self._turn.output

    def retune(self, parameters: FollowParameters) -> None:
        """Go on with other parameters.

        Raises:
            ConfigurationError: The distance of the virtual point is too large for the route;
                nothing has changed.

        """
        self._virtual.set_radius(parameters.virtual_point_distance)
        self._parameters, self._profiles = parameters, parameters.profiles()
        form = CouplingForm(parameters.coupling_form)
        self._speed.set(parameters.speed_coupling_ms / 1000.0, form)
        self._turn.set(parameters.turn_coupling_ms / 1000.0, form)

    def rest(self) -> None:
        """Take note that the robot has been stopped: the couplings start anew from rest."""
        for coupling in (self._speed, self._turn):
            coupling.rest()

    def step(self, pose: Pose, dt: float) -> RouteStep:
        """Return what to do at ``pose``, ``dt`` [s] after the last step (or the start).

        Once arrived it stays so, with a twist of zero.

        Raises:
            SignalError: A number is not finite, or ``dt`` is negative.

        """
        require_finite('pose', pose)
        if not isfinite(dt) or dt < 0.0:
            msg = f'dt = {dt} s: must be finite and not negative'
            raise SignalError(msg)
        before = self.segment
        self._virtual.advance(pose.x, pose.y)
        if self.segment != before:
            self._speed.reset()
            self._turn.reset()
        limits = self._limits(pose)
        last = self.route.is_last(self.segment)
        self.arrived = self.arrived or (last and limits.v_d <= self._parameters.arrival_speed)
        if self.arrived:
            return RouteStep(REST, self._virtual.point, limits, arrived=True)
        speed = self._speed.follow(limits.speed, dt)
        rate = self._profiles.omega_dphi(abs(limits.heading_error))
        turn_rate = self._turn.follow(copysign(rate, limits.heading_error), dt)
        if speed != limits.speed:
            limits = limits._replace(limiter=RouteLimiter.COUPLING)
        return RouteStep(
            self._twist(speed, turn_rate, limits.heading_error),
            self._virtual.point,
            limits,
            arrived=False,
        )

    def _limits(self, pose: Pose) -> RouteLimits:
        """Return the measures at ``pose`` and the speeds of the tables."""
        route, place, point = self.route, self._virtual.place, self._virtual.point
        dx, dy = point.x - pose.x, point.y - pose.y
        to_go = hypot(dx, dy) + route.length - route.way(place)
        error = wrap(atan2(dy, dx) - pose.theta) if dx or dy else 0.0
        to_waypoint = route.segment(place.segment).length - place.way
        bend = route.bend(place.segment)
        found = route_speeds(self._profiles, error, to_waypoint, bend, to_go)
        return RouteLimits(
            to_go, error, to_waypoint, bend,
            found.v_d, found.v_dphi, found.v_dn, found.v_alpha, found.speed, found.limiter,
        )  # fmt: skip

    def _twist(self, speed: float, turn_rate: float, heading_error: float) -> Twist:
        if self._parameters.holonomic:
            return Twist(speed * cos(heading_error), speed * sin(heading_error), turn_rate)
        return Twist(speed, 0.0, turn_rate)
