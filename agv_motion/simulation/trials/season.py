"""Days of several trees in one zone, by their real agents, in seconds: what must hold, counted.

Kinematic and without ROS: sun and shade make sap flow, sap flow and memory make goals, traffic
makes path, and the platform follows exactly what it is told, off by the error of its position. Only
the opening hours are played; at night the trees stand and speak on.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from itertools import combinations
from math import hypot, inf
from typing import TYPE_CHECKING, Annotated, NamedTuple

from agv_motion.motion.behavior.agent import Agent
from agv_motion.motion.behavior.goals.strategies import STRATEGIES, GoalParameters
from agv_motion.motion.behavior.homing import HomeParameters
from agv_motion.motion.behavior.parameters import AgentParameters
from agv_motion.motion.behavior.schedule import DAYS, ScheduleParameters
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.motion.navigation.reservations.right_of_way import RightOfWay
from agv_motion.motion.navigation.reservations.shared_navigator import SharedNavigator
from agv_motion.parameters import Spec, check
from agv_motion.simulation.radio import Radio, RadioParameters
from agv_motion.simulation.sap import PERIOD
from agv_motion.simulation.shade import Obstacle, light_factor
from agv_motion.simulation.trials.crowd import scattered
from agv_motion.simulation.trials.season_tree import SeasonTree
from agv_motion.simulation.trials.season_zones import MOST_TREES, plan_of
from agv_motion.sun import sun

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.motion.navigation.zone import Zone
    from agv_motion.planar import Pose
    from agv_motion.sun import Sun

LATITUDE, LONGITUDE = 48.86, 2.35

FIRST_OPENING = 1_430_438_400.0 + 10 * 3600.0
"""[s since 1970] 1 May 2015, 10:00 UTC."""

DAY = 86400.0

REMEMBERING = tuple(name for name, kind in STRATEGIES.items() if kind.remembers)
"""strategies that need nobody to tell them a goal"""


@dataclass(frozen=True)
class SeasonParameters:
    """Which trees spend how many days where."""

    kind: Annotated[str, Spec('of the zone', choices=tuple(MOST_TREES))] = 'garden'
    trees: Annotated[int, Spec('how many share it', '1', (1, 10))] = 2
    days: Annotated[int, Spec('how many opening days', '1', (1, 10000))] = 20
    hours: Annotated[float, Spec('for which each day is open', 'h', (1.0, 12.0))] = 8.0
    seed: Annotated[int, Spec('of zone, weather, noise and network', '1', (0, 2**31))] = 1
    strategy: Annotated[str, Spec('of the goals', choices=REMEMBERING)] = 'memory'
    step: Annotated[float, Spec('time step while a tree moves', 's', (0.5, 60.0))] = 15.0
    error: Annotated[
        float, Spec('standard deviation of x and of y, never beyond three of it', 'm', (0.0, 0.5))
    ] = 0.02
    outages: Annotated[
        float, Spec('share of days on which one tree is off the air for an hour', '1', (0.0, 1.0))
    ] = 0.1
    radio: RadioParameters = field(default_factory=lambda: RadioParameters(delay=15.0))
    traffic: TrafficParameters = field(
        default_factory=lambda: TrafficParameters(silent_after=90.0, listen=30.0)
    )

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class Tally(NamedTuple):
    """What has come of the days."""

    days: int
    walked: float
    """[m] by all trees"""
    goals: int
    """taken by all trees"""
    least_inside: float
    """[m] least distance of the rim of a tree from an edge; negative: over it"""
    least_gap: float
    """[m] least distance between two trees less what is allowed; infinite with one tree"""
    longest_stand: float
    """[s] longest standstill of a tree that had somewhere to go and heard the others"""
    coverage: tuple[float, ...]
    """share of the reachable floor the first tree has stood over, after each day"""


class _Seen:
    """What has been seen of all days so far; see `Tally`."""

    def __init__(self) -> None:
        self.least_gap = self.least_inside = inf
        self.coverage: list[float] = []


class Season:
    """Trees, zone, weather, network."""

    def __init__(self, parameters: SeasonParameters) -> None:
        """Put the trees at their homes."""
        self.parameters = given = parameters
        chance = random.Random(given.seed)  # noqa: S311 - a simulation, no secret
        plan = plan_of(given.kind, given.seed)
        self.zone = plan.zone()
        clearance = given.traffic.clearance + HomeParameters().arrival + 0.1
        homes = scattered(self.zone, given.trees, clearance, chance)
        self._obstacles = _obstacles(self.zone, chance)
        names = [f'tree_{i}' for i in range(given.trees)]
        self.trees = []
        for name, home in zip(names, homes, strict=True):
            planner = PathPlanner(plan.zone(home))
            agent = Agent(planner, _agent(given, chance))
            navigator = SharedNavigator(RightOfWay(name, home, given.traffic), planner)
            self.trees.append(SeasonTree(name, agent, navigator, home, chance))
        self._radio = Radio(names, given.radio, given.seed)
        self._chance = chance
        self._seen = _Seen()

    def run(self, told: Callable[[], None] = lambda: None) -> Tally:
        """Let all days pass; ``told`` is called after each."""
        for day in range(self.parameters.days):
            self._day(FIRST_OPENING + day * DAY)
            told()
        return self.tally()

    def tally(self) -> Tally:
        """Return what has come of the days so far."""
        trees = self.trees
        return Tally(
            len(self._seen.coverage),
            sum(tree.walked for tree in trees),
            sum(tree.goals for tree in trees),
            self._seen.least_inside,
            self._seen.least_gap,
            max(tree.longest_stand for tree in trees),
            tuple(self._seen.coverage),
        )

    def _day(self, opening: float) -> None:
        given = self.parameters
        closing = opening + 3600.0 * given.hours
        self._speak_all_night(opening - 3.0 * given.step)
        outage, lost = inf, self._chance.choice(self.trees).name
        if self._chance.random() < given.outages:
            outage = opening + self._chance.uniform(0.0, closing - 3600.0 - opening)
        now, reading, sky = opening, -inf, sun(opening, LATITUDE, LONGITUDE)
        while now < closing:
            if now >= reading + PERIOD:
                reading, sky = now, sun(now, LATITUDE, LONGITUDE)
            off = outage <= now < outage + 3600.0
            self._radio.deaf = self._cut_off(lost) if off else set()
            moving = self._step(now, sky)
            if off:  # who does not hear the others has to keep to its side, wherever it would go
                for tree in self.trees:
                    tree.count_from(now)
            now += given.step if moving else PERIOD
        memory = self.trees[0].agent.memory
        assert memory is not None
        self._seen.coverage.append(memory.coverage()[0])

    def _speak_all_night(self, now: float) -> None:
        """Bring every tree's last word to every other, as in all the hours left out."""
        given = self.parameters
        self._radio.deaf = set()
        self._radio.receive(inf)
        for speaker in self.trees:
            reservation = speaker.navigator.reservation(now)
            for listener in self.trees:
                if listener is not speaker:
                    listener.navigator.right.receive(reservation, now)
        for tree in self.trees:
            tree.live(now, lambda _x, _y: 1.0, given.step, given.error)

    def _cut_off(self, name: str) -> set[tuple[str, str]]:
        others = [tree.name for tree in self.trees if tree.name != name]
        return {(name, other) for other in others} | {(other, name) for other in others}

    def _step(self, now: float, sky: Sun) -> bool:
        """Let one step pass; return whether any tree moves."""
        given = self.parameters
        by_name = {tree.name: tree for tree in self.trees}
        for receiver, reservation in self._radio.receive(now):
            by_name[receiver].navigator.right.receive(reservation, now)

        def light(x: float, y: float) -> float:
            return light_factor(x, y, sky, self._obstacles)

        moving = False
        for tree in self.trees:
            moving |= tree.live(now, light, given.step, given.error)
            if len(self.trees) > 1:
                self._radio.send(tree.navigator.reservation(now), now)
            self._seen.least_inside = min(self._seen.least_inside, self._inside(tree.pose))
        allowed = 2.0 * given.traffic.body + given.traffic.margin
        for a, b in combinations(self.trees, 2):
            gap = hypot(a.pose.x - b.pose.x, a.pose.y - b.pose.y) - allowed
            self._seen.least_gap = min(self._seen.least_gap, gap)
        return moving

    def _inside(self, pose: Pose) -> float:
        """Return how far the rim of a tree is inside the edge [m]; negative: over it."""
        sign = 1.0 if self.zone.contains(pose.x, pose.y) else -1.0
        return sign * self.zone.edge_distance(pose.x, pose.y) - self.zone.rim


def _agent(given: SeasonParameters, chance: random.Random) -> AgentParameters:
    return AgentParameters(
        goals=GoalParameters(strategy=given.strategy, seed=chance.randrange(2**20)),
        schedule=ScheduleParameters(enabled=True, days=DAYS),
    )


def _obstacles(zone: Zone, chance: random.Random) -> list[Obstacle]:
    """Return houses and trees that stand round the zone and throw shadows into it."""
    west, south, east, north = zone.bounds
    return [
        Obstacle(chance.uniform(west, east), south - 2.0, 2.0, chance.uniform(5.0, 12.0)),
        Obstacle(east + 2.0, chance.uniform(south, north), 2.0, chance.uniform(5.0, 12.0)),
        Obstacle(west - 2.0, chance.uniform(south, north), 2.0, chance.uniform(5.0, 12.0)),
    ]
