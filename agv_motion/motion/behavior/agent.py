"""The tree's mind: time, pose and sap flow in; what to do, where to, by which path, and why, out.

All that a tree decides is decided here, in the node and in simulations alike. In this order: the
hours of the day, the edge of the zone, the path home, sleep, the goal, and the path to it.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import hypot, inf
from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.motion.behavior.decision import ALONE, Decision, Surroundings
from agv_motion.motion.behavior.goals import Goal, GoalParameters, GoalSelector, Objective
from agv_motion.motion.behavior.homing import HomeParameters, Homing
from agv_motion.motion.behavior.memory import Memory, MemoryParameters
from agv_motion.motion.behavior.sap_flow import RestParameters, SapFlow, Sleep
from agv_motion.motion.behavior.schedule import ALWAYS, Phase, Schedule, ScheduleParameters
from agv_motion.motion.command.limits import FloorRules
from agv_motion.motion.command.polar import (
    LINEAR_SPEED,
    PLATFORM_RADIUS,
    STILL,
    PolarCommand,
    polar_command,
)
from agv_motion.motion.navigation.path_follower import PathFollower

if TYPE_CHECKING:
    from agv_motion.motion.navigation.path_planner import Point
    from agv_motion.motion.navigation.zone import Zone
    from agv_motion.planar import Pose

LEAVE = 2.0
"""[-] A tree that has arrived for good sets out again only from so many times the distance of
arrival, so that the noise of position fixes does not send it to and fro."""


@dataclass(frozen=True)
class AgentParameters:
    """All that shapes the decisions of one tree."""

    goals: GoalParameters = field(default_factory=GoalParameters)
    memory: MemoryParameters = field(default_factory=MemoryParameters)
    rest: RestParameters = field(default_factory=RestParameters)
    schedule: ScheduleParameters = field(default_factory=ScheduleParameters)
    home: HomeParameters = field(default_factory=HomeParameters)
    goal: Point | None = None
    """where to go first, and with the strategy `fixed` for good [m]"""
    linear_speed: float = LINEAR_SPEED
    """[m/s] at v = 1"""
    platform_radius: float = PLATFORM_RADIUS
    """[m] how far the platform reaches: what must not turn over delicate floor"""
    corner_reach: float = 0.3
    """[m] a corner of the path counts as reached from here: twice the noise of a position fix"""
    corner_slack: float = 0.01
    """[m] by which skipping it may cut into the margin"""


class Agent:
    """Memory, goal and path of one tree."""

    def __init__(self, zone: Zone | None, parameters: AgentParameters | None = None) -> None:
        """Wake up without memory.

        Args:
            zone: Where it may walk; None: anywhere, towards a given goal.
            parameters: How it decides.

        Raises:
            ConfigurationError: The strategy needs a zone and there is none, or the first goal is
                not walkable.

        """
        self.parameters = given = parameters or AgentParameters()
        self.zone = zone
        self._fixed = given.goals.strategy == 'fixed'
        if zone is None and not self._fixed:
            msg = f"strategy '{given.goals.strategy}' remembers places of a zone: give zone_file"
            raise ConfigurationError(msg)
        self.memory = None if zone is None else Memory(zone, given.memory, given.platform_radius)
        self._course = (
            None if zone is None else PathFollower(zone, given.corner_reach, given.corner_slack)
        )
        home = None if zone is None else zone.home
        self._homing = Homing(home, self._course, given.home, given.linear_speed)
        self._cycle = GoalSelector(given.goals)
        self._sleep = Sleep(given.rest)
        self._schedule = Schedule(given.schedule)
        self._hour, self._hour_from = ALWAYS, inf
        self._retry_at = -inf
        self._arrived = False
        self._seen: Pose | None = None
        self._inside, self._place = True, FloorRules()
        self.refusals: list[str] = []
        """Why goals before the present one were not taken, in words."""
        self.goal: Goal | None = None
        if given.goal is not None:
            self.set_goal(*given.goal, 'the first one')

    @property
    def rest(self) -> RestParameters:
        """When the tree rests, and when it has arrived; may be set."""
        return self._sleep.parameters

    @rest.setter
    def rest(self, value: RestParameters) -> None:
        self._sleep.parameters = value

    def set_goal(self, x: float, y: float, why: str) -> None:
        """Take (x, y) [m] as the goal.

        Raises:
            ConfigurationError: The platform cannot stand there; the old goal stays.

        """
        if self.zone is not None and not self.zone.walkable(x, y):
            msg = f'goal ({x:.2f}, {y:.2f}) {self.zone.why_not(x, y)}: choose another'
            raise ConfigurationError(msg)
        self._take(Goal(x, y, f'({x:.1f}, {y:.1f}), {why}'))
        self._homing.why = ''

    def next_goal(self) -> None:
        """Drop the present goal, or the path home; the next thought chooses another.

        Raises:
            ConfigurationError: With the strategy `fixed` there is no other.

        """
        if self._fixed and not self._homing.why:
            msg = "strategy 'fixed' has one goal: send another to goal_pose, or choose 'memory'"
            raise ConfigurationError(msg)
        self._take(self.goal if self._fixed else None)
        self._homing.why, self._retry_at = '', -inf

    def go_home(self, why: str = 'asked to') -> None:
        """Go home and stay there.

        Raises:
            ConfigurationError: The zone has no home.

        """
        self._homing.send(why)
        self._arrived = False

    def decide(
        self, time: float, pose: Pose, flow: SapFlow, surroundings: Surroundings = ALONE
    ) -> Decision:
        """Return what to do now.

        Args:
            time: Now, seconds since 1970.
            pose: Of the platform in the map.
            flow: Normalised sap flow, checked and believed.
            surroundings: What others allow.

        """
        asleep = self._sleep.update(flow)
        if not self._hour_from <= time < self._hour.until:
            self._hour, self._hour_from = self._schedule.hour(time), time
        hour = self._hour
        if hour.phase is not Phase.OPEN:
            self._homing.why = ''
            until = self._schedule.clock(hour.until)
            return self._stay(f'resting: {hour.phase.value} until {until}')
        if pose != self._seen:
            self._look(pose)
        here = pose.x, pose.y
        if not self._inside:
            return self._outside(pose, flow, asleep=asleep)
        if self.memory is not None and not asleep:
            self.memory.update(time, *here, flow.s3)
        if not self._homing.why and self._homing.is_due(time, here, hour.until):
            self.go_home(f'closing at {self._schedule.clock(hour.until)}')
        if self._homing.why:
            return self._walk_home(time, pose, flow, surroundings)
        if asleep:
            decision = self._stay('resting: the sap stands')
        else:
            decision = self._seek(time, pose, flow, surroundings)
        return decision._replace(aside=self.parameters.home.speed)

    def _look(self, pose: Pose) -> None:
        """Ask the zone about a pose, once; poses come less often than thoughts."""
        self._seen = pose
        if self.zone is not None:
            self._inside = self.zone.holds(pose.x, pose.y)
            radius = self.parameters.platform_radius
            self._place = FloorRules(self.zone.may_turn(pose.x, pose.y, radius))

    def _outside(self, pose: Pose, flow: SapFlow, *, asleep: bool) -> Decision:
        """Refuse to move outside the zone, or return to it."""
        assert self.zone is not None
        why = f'the tree {self.zone.why_not(pose.x, pose.y)}'
        home = self.parameters.home
        if home.outside == 'refuse':
            return self._stay(f'stopped: {why}; drive it back, or set home.outside to return')
        if asleep:
            return self._stay(f'resting: the sap stands, and {why}')
        try:
            back = self.zone.way_back(pose.x, pose.y)
        except GeometryError as error:
            return self._stay(f'stopped: {error}')
        wanted = polar_command(pose, back, flow.s1, 0.0)
        place = FloorRules(may_turn=True, top_speed=home.return_speed)
        path = ((pose.x, pose.y), back)
        return Decision(wanted, f'returning slowly to the zone: {why}', place, self.goal, path)

    def _walk_home(
        self, time: float, pose: Pose, flow: SapFlow, surroundings: Surroundings
    ) -> Decision:
        """Go home, even if little sap flows; stay there."""
        home, given, why = self._homing.home, self.parameters.home, self._homing.why
        assert home is not None
        reason = f'home at ({home[0]:.1f}, {home[1]:.1f}), {why}'
        goal = Goal(*home, reason)
        if self._near(pose, home, given.arrival):
            return self._stay(f'at home: {why}', goal)
        flow = flow._replace(s1=max(flow.s1, given.speed), s2=0.5)
        return self._walk(time, pose, flow, goal, surroundings)

    def _near(self, pose: Pose, place: Point, arrival: float) -> bool:
        """Return whether the tree is at ``place``; once it is, noise does not carry it away."""
        distance = hypot(place[0] - pose.x, place[1] - pose.y)
        self._arrived = distance < arrival * (LEAVE if self._arrived else 1.0)
        return self._arrived

    def _seek(self, time: float, pose: Pose, flow: SapFlow, surroundings: Surroundings) -> Decision:
        """Go to the goal; when there, to the next one."""
        if self._fixed:
            return self._seek_fixed(time, pose, flow, surroundings)
        if self.goal is not None and self._is_reached(pose, self.goal):
            self._take(None)
        if self.goal is None and time >= self._retry_at:
            self._choose(time, pose, surroundings)
        if self.goal is None:
            return self._turn(flow, 'no goal can be reached: turning on the spot')
        decision = self._walk(time, pose, flow, self.goal, surroundings)
        if not decision.path:  # the path has been taken by others: look for another goal
            self._take(None)
        return decision

    def _seek_fixed(
        self, time: float, pose: Pose, flow: SapFlow, surroundings: Surroundings
    ) -> Decision:
        """Go to the one goal and turn there."""
        if self.goal is None:
            return self._stay('resting: no goal; send one to goal_pose')
        if self._near(pose, self.goal.place, self.rest.arrival):
            return self._turn(flow, 'turning on the spot at the goal')
        return self._walk(time, pose, flow, self.goal, surroundings)

    def _is_reached(self, pose: Pose, goal: Goal) -> bool:
        return hypot(goal.x - pose.x, goal.y - pose.y) < self._arrival(goal.objective)

    def _arrival(self, objective: Objective | None) -> float:
        """Return the distance of arrival; what is to be visited must come under the platform."""
        arrival = self.rest.arrival
        if objective is Objective.UNKNOWN and self.memory is not None:
            return min(arrival, 0.8 * self.memory.reach)
        return arrival

    def _choose(self, time: float, pose: Pose, surroundings: Surroundings) -> None:
        """Take the next goal of the cycle; if none can be reached, try again later."""
        assert self.memory is not None
        assert self._course is not None
        paths = self._course.free(surroundings.avoid)
        choice = self._cycle.next(time, (pose.x, pose.y), self.memory, paths, self._arrival)
        self.refusals = choice.failures
        self._take(choice.goal)
        if choice.goal is None:
            self._retry_at = time + self.parameters.goals.retry_after

    def _walk(
        self, time: float, pose: Pose, flow: SapFlow, goal: Goal, surroundings: Surroundings
    ) -> Decision:
        """Head for the next corner of the path to ``goal``."""
        here = pose.x, pose.y
        path: tuple[Point, ...] = (here, goal.place)
        if self._course is not None:
            try:
                path = self._course.to(time, here, goal.place, surroundings.avoid)
            except GeometryError as error:
                return self._stay(f'stopped: {error}', goal)
        if surroundings.wait:
            return Decision(STILL, f'waiting: {surroundings.wait}', self._place, goal, path)
        wanted = polar_command(pose, path[1], flow.s1, flow.rotation)
        return Decision(wanted, f'walking to {goal.reason}', self._place, goal, path)

    def _turn(self, flow: SapFlow, activity: str) -> Decision:
        wanted = PolarCommand(0.0, 0.0, flow.rotation)
        return Decision(wanted, activity, self._place, self.goal, ())

    def _stay(self, activity: str, goal: Goal | None = None) -> Decision:
        return Decision(STILL, activity, FloorRules(), goal or self.goal, ())

    def _take(self, goal: Goal | None) -> None:
        self.goal, self._arrived = goal, False
