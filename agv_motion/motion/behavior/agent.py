"""The agent of a tree: time, pose and sap flow in; what to do, where to go, how, and why, out.

All that a tree decides is decided here, in the node and in simulations alike. In this order: the
hours of the day, the edge of the zone, the way home, sleep, and the goal. By which path it gets
there is the matter of its navigator.
"""

from __future__ import annotations

from math import hypot, inf
from typing import TYPE_CHECKING

from agv_motion.activity import Activity, Cause
from agv_motion.errors import ConfigurationError
from agv_motion.motion.behavior.decision import Decision, resting, standing
from agv_motion.motion.behavior.goals.goal import Goal, Objective
from agv_motion.motion.behavior.goals.strategy import GoalSetting
from agv_motion.motion.behavior.ground import Ground
from agv_motion.motion.behavior.homing import Homing
from agv_motion.motion.behavior.memory import Memory
from agv_motion.motion.behavior.parameters import AgentParameters
from agv_motion.motion.behavior.sap_flow import Sleep
from agv_motion.motion.behavior.schedule import ALWAYS, Phase, Schedule
from agv_motion.motion.navigation.open_floor import OpenFloor

if TYPE_CHECKING:
    import shapely

    from agv_motion.motion.behavior.sap_flow import SapFlow
    from agv_motion.motion.behavior.schedule import Hour
    from agv_motion.motion.navigation.path_planner import PathPlanner
    from agv_motion.motion.navigation.polyline import Point
    from agv_motion.planar import Pose

LEAVE = 2.0
"""[-] A tree that has arrived for good sets out again only from so many times the distance of
arrival, so that the noise of position fixes does not send it to and fro."""


class Agent:
    """Memory and goal of one tree."""

    def __init__(
        self, planner: PathPlanner | None, parameters: AgentParameters | None = None
    ) -> None:
        """Wake up without memory.

        Args:
            planner: The paths in the zone of the tree; None: it may go anywhere, straight.
            parameters: How it decides.

        Raises:
            ConfigurationError: The strategy needs a zone and there is none, or the first goal is
                not walkable.

        """
        self.parameters = given = parameters or AgentParameters()
        self.planner = planner
        """Of the zone of the tree, for whoever navigates there; None: it knows of no zone."""
        self.zone = zone = None if planner is None else planner.zone
        """Where the tree may be; None: anywhere"""
        if zone is None and given.goals.kind.remembers:
            msg = f"strategy '{given.goals.strategy}' remembers places of a zone: give zone_file"
            raise ConfigurationError(msg)
        self.memory = None if zone is None else Memory(zone, given.memory, given.platform_radius)
        self._floor = None if planner is None else OpenFloor(planner)
        self._homing = Homing(planner, given.home, given.linear_speed)
        self._sleep = Sleep(given.rest)
        self._take_hours(given)
        self._tried_at = -inf
        self._arrived = False
        self._ground = Ground(zone, given.platform_radius, given.home)
        self._strategy = given.goals.kind.build(
            GoalSetting(
                given.goal, given.goals.seed, given.goals.attempts, self._floor, self._arrival
            )
        )
        self.goal: Goal | None = None
        if self._strategy.first is not None:
            self._take(self._checked(self._strategy.first))

    def retune(self, parameters: AgentParameters) -> None:
        """Take over other hours, and other thresholds of rest and arrival."""
        self.parameters = parameters
        self._sleep.parameters = parameters.rest
        self._take_hours(parameters)

    def moved_to(self, planner: PathPlanner) -> Agent:
        """Return what goes on from here in another zone, as after a restart there.

        Places that are still there are remembered; a goal there, and the way home, stay.

        Raises:
            AgvMotionError: The first goal is not walkable, or the memory does not suit the zone.

        """
        other = Agent(planner, self.parameters)
        assert other.zone is not None
        if self.memory is not None and other.memory is not None:
            other.memory.recall(self.memory.grid())
        if self.goal is not None and other.zone.walkable(*self.goal.place):
            other.goal = self.goal
        if other._homing.home is not None:
            other._homing.why, other._homing.because = self._homing.why, self._homing.because
        other._sleep.resting = self._sleep.resting
        return other

    def _take_hours(self, parameters: AgentParameters) -> None:
        self._schedule = Schedule(parameters.schedule, parameters.rest_until)
        self._hour, self._hour_from = ALWAYS, inf

    def hour_now(self, time: float) -> Hour:
        """Return what the hour is for at ``time`` [s since 1970], and until when."""
        if not self._hour_from <= time < self._hour.until:
            self._hour, self._hour_from = self._schedule.hour(time), time
        return self._hour

    @property
    def home(self) -> Point | None:
        """Where it is parked [m]; None: its zone has no home."""
        return self._homing.home

    @property
    def refusals(self) -> list[str]:
        """Why goals before the present one were not taken, in words."""
        return self._strategy.refusals

    def set_goal(self, x: float, y: float, why: str) -> None:
        """Take (x, y) [m] as the goal.

        Raises:
            ConfigurationError: The platform cannot stand there; the old goal stays.

        """
        self._take(self._checked(Goal(x, y, f'({x:.1f}, {y:.1f}), {why}')))
        self._homing.why = ''

    def next_goal(self) -> None:
        """Drop the present goal, or the way home; the next decision chooses another.

        Raises:
            ConfigurationError: The strategy has one goal, and there is no other.

        """
        lasting = self._strategy.lasting
        if lasting and not self._homing.why:
            msg = (
                f"strategy '{self.parameters.goals.strategy}' has one goal: send another to "
                "goal_pose, or choose 'memory'"
            )
            raise ConfigurationError(msg)
        self._take(self.goal if lasting else None)
        self._homing.why, self._tried_at = '', -inf

    def give_up(self, goal: Goal) -> bool:
        """Drop ``goal``, to which the tree cannot go; return whether it will choose another.

        A goal that lasts, that has been replaced meanwhile, or that was only the way home, is none
        of the agent's own choice, and stays.
        """
        if goal is not self.goal or self._strategy.lasting:
            return False
        self._take(None)
        self._tried_at = -inf
        return True

    def go_home(self, why: str = 'asked to', because: Cause = Cause.PERSON) -> None:
        """Go home and stay there.

        Raises:
            ConfigurationError: The zone has no home.

        """
        self._homing.send(why, because)
        self._arrived = False

    def decide(
        self, time: float, pose: Pose, flow: SapFlow, closed: shapely.Geometry | None = None
    ) -> Decision:
        """Return what to do now.

        Args:
            time: Now, seconds since 1970.
            pose: Of the platform in the map.
            flow: Normalised sap flow, checked and believed.
            closed: Floor on which a goal chosen now would make no sense, as others are there.

        """
        asleep = self._sleep.update(flow)
        hour = self.hour_now(time)
        if hour.phase is not Phase.OPEN:
            self._homing.why = ''
            until = self._schedule.clock(hour.until)
            return standing(hour.phase.sentence(until), self.goal, *hour.phase.means)
        self._ground.look(pose)
        here = pose.x, pose.y
        if not self._ground.inside:
            return self._ground.leave(here, flow, self.goal, asleep=asleep)
        if self.memory is not None and not asleep:
            self.memory.update(time, *here, flow.s3)
        closes = hour.until < inf and not self._homing.why
        if closes and self._homing.is_due(time, here, hour.until):
            self.go_home(f'closing at {self._schedule.clock(hour.until)}', Cause.HOURS)
        if self._homing.why:
            return self._go_home(here, flow)
        if asleep:
            return resting('the sap stands', self.goal, Cause.SAP, self._least)
        return self._seek(time, here, flow, closed)

    def _go_home(self, here: Point, flow: SapFlow) -> Decision:
        """Go home, even if little sap flows; stay there."""
        home, given, why = self._homing.home, self.parameters.home, self._homing.why
        assert home is not None
        goal = Goal(*home, f'home at ({home[0]:.1f}, {home[1]:.1f}), {why}')
        if self._near(here, home, given.arrival):
            return Decision(f'at home: {why}', goal, because=self._homing.because)
        way = self._go(goal, max(flow.s1, given.speed), 0.0, yields=False)
        return way._replace(because=self._homing.because)

    def _near(self, here: Point, place: Point, arrival: float) -> bool:
        """Return whether the tree is at ``place``; once it is, noise does not carry it away."""
        distance = hypot(place[0] - here[0], place[1] - here[1])
        self._arrived = distance < arrival * (LEAVE if self._arrived else 1.0)
        return self._arrived

    def _seek(
        self, time: float, here: Point, flow: SapFlow, closed: shapely.Geometry | None
    ) -> Decision:
        """Go to the goal; when there, turn or go to the next one."""
        lasting = self._strategy.lasting
        if self.goal is not None and not lasting and self._is_reached(here, self.goal):
            self._take(None)
        since = time - self._tried_at
        if self.goal is None and not 0.0 <= since < self.parameters.goals.retry_after:
            self._choose(time, here, closed)
        if self.goal is None and lasting:
            idle = resting('no goal; send one to goal_pose', None, Cause.NOTHING, self._least)
            return idle._replace(activity=Activity.WAITING)
        if self.goal is None:
            return self._turn(flow, 'no goal can be reached: turning on the spot', Cause.ZONE)
        if lasting and self._near(here, self.goal.place, self.parameters.rest.arrival):
            return self._turn(flow, 'turning on the spot at the goal')
        return self._go(self.goal, flow.s1, flow.rotation)

    def _is_reached(self, here: Point, goal: Goal) -> bool:
        return hypot(goal.x - here[0], goal.y - here[1]) < self._arrival(goal.objective)

    def _arrival(self, objective: Objective | None) -> float:
        """Return the distance of arrival; what is to be visited must come under the platform."""
        arrival = self.parameters.rest.arrival
        if objective is Objective.UNKNOWN and self.memory is not None:
            return min(arrival, 0.8 * self.memory.reach)
        return arrival

    def _choose(self, time: float, here: Point, closed: shapely.Geometry | None) -> None:
        """Take the next goal of the strategy; if none can be reached, try again later."""
        if self._floor is not None:
            self._floor.close(closed)
        self._take(self._strategy.next_goal(self.memory, here, time))
        if self.goal is None:
            self._tried_at = time

    def _checked(self, goal: Goal) -> Goal:
        """Return ``goal`` if the platform can stand there.

        Raises:
            ConfigurationError: It cannot.

        """
        if self.zone is not None and not self.zone.walkable(*goal.place):
            why = self.zone.why_not(*goal.place)
            msg = f'goal ({goal.x:.2f}, {goal.y:.2f}) {why}: choose another'
            raise ConfigurationError(msg)
        return goal

    def _take(self, goal: Goal | None) -> None:
        self.goal, self._arrived = goal, False

    # Decisions; who seeks gives way to others, at this speed at least

    @property
    def _least(self) -> float:
        """Speed v at least of one that gives way to others."""
        return self.parameters.home.speed

    def _go(self, goal: Goal, speed: float, rotation: float, *, yields: bool = True) -> Decision:
        return Decision(
            f'walking to {goal.reason}', goal, goal.place, speed, rotation,
            self._least if yields else 0.0, rules=self._ground.rules, activity=Activity.WALKING,
        )  # fmt: skip

    def _turn(self, flow: SapFlow, state: str, because: Cause = Cause.GOAL) -> Decision:
        return Decision(
            state, self.goal, None, 0.0, flow.rotation, self._least, rules=self._ground.rules,
            activity=Activity.TURNING, because=because,
        )  # fmt: skip
