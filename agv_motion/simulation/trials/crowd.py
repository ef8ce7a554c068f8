"""Several trees that walk between random goals in one zone over a bad network: a trial of traffic.

Fast, without ROS: each tree is a point that follows its way exactly, off by a slow error of
position. What is measured is what must hold: how near any two come, and how long one stands.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from itertools import combinations
from math import exp, hypot, inf, sqrt
from typing import TYPE_CHECKING, Annotated

import numpy as np
import shapely

from agv_motion.errors import GeometryError
from agv_motion.motion.command.polar import LINEAR_SPEED
from agv_motion.motion.navigation.navigator import Guidance
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.motion.navigation.reservations.right_of_way import RightOfWay
from agv_motion.motion.navigation.reservations.shared_navigator import SharedNavigator
from agv_motion.parameters import Spec, check
from agv_motion.simulation.radio import Radio, RadioParameters

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from agv_motion.motion.navigation.polyline import Point
    from agv_motion.motion.navigation.zone import Zone

ARRIVAL = 1.0
"""[m] A goal counts as reached from here."""

MEMORY = 300.0
"""[s] over which the error of a position is about the same."""


@dataclass(frozen=True)
class CrowdParameters:
    """Who walks, and how well they hear and know where they are."""

    trees: Annotated[int, Spec('how many', '1', (1, 20))] = 2
    seed: Annotated[int, Spec('of all chance', '1', (0, 2**31))] = 1
    step: Annotated[float, Spec('time step', 's', (0.1, 60.0))] = 5.0
    slowest: Annotated[float, Spec('share of the top speed, at least', '1', (0.0, 1.0))] = 0.3
    error: Annotated[float, Spec('standard deviation of a position', 'm', (0.0, 1.0))] = 0.05
    skew: Annotated[float, Spec('clocks differ by up to', 's', (0.0, 1e4))] = 3.0
    radio: RadioParameters = field(default_factory=RadioParameters)
    traffic: TrafficParameters = field(default_factory=TrafficParameters)

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class Walker:
    """One tree of the crowd: it goes where chance sends it."""

    def __init__(self, name: str, place: Point, navigator: SharedNavigator, seed: int) -> None:
        """Stand at ``place``."""
        self.name, self.place, self.navigator = name, place, navigator
        self.goal: Point | None = None
        self.guidance = Guidance()
        self.arrivals = 0
        self.moved_at = 0.0
        self.longest_stand = 0.0
        self.skew = 0.0
        self.resting = False
        self._anchor = place
        self._error = [0.0, 0.0]
        self._random = random.Random(seed)  # noqa: S311 - a simulation, no secret
        self.speed = self._random.uniform(0.3, 1.0)

    def supposed(self, step: float, error: float) -> Point:
        """Return where it believes it is: off by an error that changes slowly."""
        keep = exp(-step / MEMORY)
        fresh = error * sqrt(1.0 - keep * keep)
        self._error = [keep * e + self._random.gauss(0.0, fresh) for e in self._error]
        return self.place[0] + self._error[0], self.place[1] + self._error[1]

    def decide(self, believed: Point, candidates: NDArray[np.float64], now: float) -> None:
        """Choose a goal where there is none, it is reached, or the way there is blocked."""
        goal = self.goal
        arrived = goal is not None and _distance(goal, believed) < ARRIVAL
        self.arrivals += arrived
        if goal is None or arrived or self.guidance.blocked > self.navigator.patience:
            reachable = candidates
            if not arrived and goal is not None:
                closed = self.navigator.closed()
                reachable = candidates[~shapely.intersects_xy(closed, *candidates.T)]
            if len(reachable):
                x, y = reachable[self._random.randrange(len(reachable))]
                self.goal = (float(x), float(y))
        self.guidance = self.navigator.navigate(self.goal, believed, now + self.skew)

    def move(self, believed: Point, reach: float, now: float) -> None:
        """Walk up to ``reach`` [m] to where its navigator says."""
        target = self.guidance.target
        if target is not None:
            away = _distance(target, believed)
            share = min(reach / away, 1.0) if away > 0.0 else 0.0
            self.place = (
                self.place[0] + share * (target[0] - believed[0]),
                self.place[1] + share * (target[1] - believed[1]),
            )
        if _distance(self.place, self._anchor) > 0.1:
            self._anchor, self.moved_at = self.place, now
        self.longest_stand = max(self.longest_stand, now - self.moved_at)


class Crowd:
    """All trees, their network, and the tally of what must hold."""

    def __init__(
        self, zone: Zone, parameters: CrowdParameters, places: list[Point] | None = None
    ) -> None:
        """Put the trees at ``places``, or at random ones that keep clear of each other."""
        self.parameters = parameters
        chance = random.Random(parameters.seed)  # noqa: S311 - a simulation, no secret
        self.candidates = grid(zone, 0.5)
        clearance = parameters.traffic.clearance
        places = places or scattered(zone, parameters.trees, clearance, chance)
        names = [f'tree_{i}' for i in range(len(places))]
        planner = PathPlanner(zone)
        self.walkers = []
        for i, (name, place) in enumerate(zip(names, places, strict=True)):
            right = RightOfWay(name, place, parameters.traffic)
            navigator = SharedNavigator(right, planner)
            walker = Walker(name, place, navigator, 1000 * parameters.seed + i)
            walker.skew = chance.uniform(-parameters.skew, parameters.skew)
            self.walkers.append(walker)
        self.radio = Radio(names, parameters.radio, parameters.seed)
        self.now = 0.0
        self.least_gap = inf
        """Least distance between two centres less what is allowed [m]."""
        self.least_held_gap = inf
        """Least distance between two ways held less the clearance [m]."""

    def run(self, seconds: float) -> None:
        """Let time pass."""
        end = self.now + seconds
        while self.now < end:
            self.step()

    def step(self) -> None:
        """Let one step of time pass: hear, decide, tell, move."""
        given = self.parameters
        self.now += given.step
        by_name = {walker.name: walker for walker in self.walkers}
        for receiver, reservation in self.radio.receive(self.now):
            walker = by_name[receiver]
            walker.navigator.right.receive(reservation, self.now + walker.skew)
        for walker in self.walkers:
            believed = walker.supposed(given.step, given.error)
            if walker.resting:
                walker.navigator.rest(believed, self.now + walker.skew)
                walker.moved_at = self.now
            else:
                walker.decide(believed, self.candidates, self.now)
                share = max(walker.speed, given.slowest)
                walker.move(believed, share * LINEAR_SPEED * given.step, self.now)
            self.radio.send(walker.navigator.reservation(self.now + walker.skew), self.now)
        self._measure()

    def _measure(self) -> None:
        traffic = self.parameters.traffic
        for a, b in combinations(self.walkers, 2):
            gap = _distance(a.place, b.place) - 2.0 * traffic.body - traffic.margin
            self.least_gap = min(self.least_gap, gap)
            held = shapely.distance(
                *(
                    shapely.LineString((*w.navigator.right.held, w.navigator.right.held[-1]))
                    for w in (a, b)
                )
            )
            self.least_held_gap = min(self.least_held_gap, held - traffic.clearance)


def grid(zone: Zone, spacing: float) -> NDArray[np.float64]:
    """Return (n, 2) walkable points of a grid [m], those of the largest part of the zone."""
    west, south, east, north = zone.bounds
    x, y = np.meshgrid(
        np.arange(west + spacing / 2.0, east, spacing),
        np.arange(south + spacing / 2.0, north, spacing),
    )
    inside = shapely.intersects_xy(zone.parts[0], x, y)
    return np.column_stack([x[inside], y[inside]])


def scattered(zone: Zone, count: int, clearance: float, chance: random.Random) -> list[Point]:
    """Return ``count`` places that keep ``clearance`` [m] and block no way.

    When all but one of the trees stand at these places, that one can go everywhere else.

    Raises:
        GeometryError: Chance finds none.

    """
    candidates = grid(zone, 0.5)
    for _ in range(1000):
        places = [candidates[chance.randrange(len(candidates))] for _ in range(count)]
        discs = shapely.buffer(shapely.points(places), clearance)
        away = shapely.distance(*np.meshgrid(shapely.points(places), shapely.points(places)))
        np.fill_diagonal(away, inf)
        if away.min() > clearance + 0.1 and all(
            isinstance(
                zone.parts[0].difference(shapely.union_all(np.delete(discs, i))), shapely.Polygon
            )
            for i in range(count)
        ):
            return [(float(x), float(y)) for x, y in places]
    msg = f'{count} trees do not fit into this zone with {clearance:.2f} m between them'
    raise GeometryError(msg)


def _distance(a: Point, b: Point) -> float:
    return hypot(a[0] - b[0], a[1] - b[1])
