"""Hours of trees that differ, start again, park, join late, over the worst of networks and clocks.

Now and then a tree believes for some seconds that it is elsewhere, once or to and fro.

What must hold whatever happens: the rims of no two come nearer than the larger of their margins.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from itertools import combinations
from math import cos, hypot, inf, sin, tau
from typing import TYPE_CHECKING, Annotated, NamedTuple

from agv_motion.motion.command.polar import LINEAR_SPEED
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.reservations.lived_time import LivedTime
from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.motion.navigation.reservations.right_of_way import RightOfWay
from agv_motion.motion.navigation.reservations.shared_navigator import SharedNavigator
from agv_motion.parameters import Spec, check
from agv_motion.simulation.radio import Radio, RadioParameters
from agv_motion.simulation.trials.crowd import Walker, grid, scattered
from agv_motion.simulation.trials.season_zones import MOST_TREES, plan_of

if TYPE_CHECKING:
    from agv_motion.motion.navigation.polyline import Point
    from agv_motion.motion.navigation.zone import Zone

STEP = 5.0
"""[s]"""

KINDS = ('square', 'garden', 'rooms', 'hall')


@dataclass(frozen=True)
class EpisodeParameters:
    """How bad it gets; all else is drawn from the seed."""

    seed: Annotated[int, Spec('of all chance', '1', (0, 2**31))] = 1
    seconds: Annotated[float, Spec('length', 's', (STEP, 1e7))] = 1800.0
    calm: Annotated[
        bool, Spec('nobody parks or starts again; delays to 15 s and losses to 30 % at the most')
    ] = False

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class EpisodeOutcome(NamedTuple):
    """What came of an episode."""

    least_gap: float
    """[m] least distance of two rims less what was promised"""
    longest_stand: float
    """[s] of a tree that had somewhere to go"""
    arrivals: int
    starts: int
    """in all, the first ones among them"""
    parkings: int
    wrong_fixes: int
    """times that a tree believed for a while to be elsewhere"""
    troubles: str
    """of the network, in words"""


class _WrongFixes:
    """When a tree believes to be elsewhere, and by how much."""

    def __init__(self) -> None:
        self.until = self.next = -inf
        self.by = (0.0, 0.0)


class _Tree:
    """One tree, its clock, and what it keeps on disk."""

    def __init__(self, walker: Walker, chance: random.Random) -> None:
        self.walker = walker
        self.known: set[str] = set()
        self.clock = chance.uniform(-1e4, 1e4)
        self.lived = LivedTime(2.0 * STEP)
        self.off_until = -inf
        self.starts_again = False
        self.wrong = _WrongFixes()

    @property
    def name(self) -> str:
        return self.walker.name


class Episode:
    """The trees of one episode, their network, and the tally of what must hold."""

    def __init__(self, parameters: EpisodeParameters | None = None) -> None:
        """Draw zone, trees and network."""
        self.parameters = given = parameters or EpisodeParameters()
        self._chance = chance = random.Random(given.seed)  # noqa: S311 - a simulation, no secret
        kind = chance.choice(KINDS)
        self._zone: Zone = plan_of(kind, given.seed).zone()
        self._planner = PathPlanner(self._zone)
        self._candidates = grid(self._zone, 0.5)
        count = chance.randint(2, MOST_TREES[kind])
        self._traffic = [self._drawn() for _ in range(count)]
        widest = max(one.radius for one in self._traffic) + max(o.margin for o in self._traffic)
        places = scattered(self._zone, count, 2.0 * widest, chance)
        self._names = [f'tree_{i}' for i in range(count)]
        late = not given.calm and count > 2 and chance.random() < 0.3
        if late:  # it stands outside, out of everybody's reach, and walks in
            west, south, *_ = self._zone.bounds
            places[-1] = (west - 2.0 * widest, south + 2.0)
        self._guests = {self._names[-1]} if late else set()
        self.trees = []
        for i, (name, place) in enumerate(zip(self._names, places, strict=True)):
            right = self._right(i, place, expects=True)
            walker = Walker(name, place, SharedNavigator(right, self._planner), given.seed + i)
            self.trees.append(_Tree(walker, chance))
        if late:
            self.trees[-1].off_until = chance.uniform(0.0, given.seconds / 2.0)
            self.trees[-1].starts_again = True
        self.radio = Radio(self._names, self._network(), given.seed)
        self.now = 0.0
        self.least_gap = inf
        self.starts, self.parkings, self.wrong_fixes = count, 0, 0

    def run(self) -> EpisodeOutcome:
        """Let the time pass."""
        while self.now < self.parameters.seconds:
            self.step()
        return EpisodeOutcome(
            self.least_gap,
            max(tree.walker.longest_stand for tree in self.trees),
            sum(tree.walker.arrivals for tree in self.trees),
            self.starts,
            self.parkings,
            self.wrong_fixes,
            str(self.radio.parameters),
        )

    def step(self) -> None:
        """Let one step of time pass: hear, decide, tell, move."""
        self.now += STEP
        by_name = {tree.name: tree for tree in self.trees}
        for tree in self.trees:
            self._let_clock_go(tree)
            if tree.off_until <= self.now and tree.starts_again:
                self._start_again(tree)
        for receiver, reservation in self.radio.receive(self.now):
            tree = by_name[receiver]
            if tree.off_until <= self.now:
                tree.known.add(reservation.name)
                tree.walker.navigator.right.receive(reservation, tree.lived.seconds)
        for tree in self.trees:
            if tree.off_until <= self.now:
                self._live(tree)
            else:
                tree.walker.moved_at = self.now
        self._measure()

    # What happens to one tree

    def _live(self, tree: _Tree) -> None:
        walker, navigator = tree.walker, tree.walker.navigator
        walker.skew = tree.lived.seconds - self.now
        tolerance = navigator.right.parameters.tolerance
        believed = walker.supposed(STEP, 0.1 * tolerance)
        dx, dy = believed[0] - walker.place[0], believed[1] - walker.place[1]
        shrink = min(0.5 * tolerance / max(hypot(dx, dy), 1e-9), 1.0)
        off = self._off(tree)
        believed = (walker.place[0] + shrink * dx + off[0], walker.place[1] + shrink * dy + off[1])
        walker.decide(believed, self._candidates, self.now)
        walker.move(believed, max(walker.speed, 0.3) * LINEAR_SPEED * STEP, self.now)
        dice = self._chance.random() if not self.parameters.calm else 1.0
        if dice < 0.003:
            navigator.park(believed, tree.lived.seconds)
            tree.off_until = self.now + self._chance.uniform(10.0, 600.0)
            self.parkings += 1
        elif dice < 0.006:
            tree.off_until = self.now + self._chance.uniform(5.0, 120.0)
            tree.starts_again = True
        self.radio.send(navigator.reservation(tree.lived.seconds), self.now)

    def _off(self, tree: _Tree) -> Point:
        """Return by how much a wrong fix puts the tree elsewhere.

        For less than it takes to be sure: who believes it for longer lets its true place go.
        """
        given = tree.walker.navigator.right.parameters
        longest = given.silent_after - 3.0 * STEP
        if self.now > tree.wrong.next and longest > 0.0 and self._chance.random() < 0.01:
            far = given.tolerance + 10.0 ** self._chance.uniform(-0.3, 1.3)
            angle = self._chance.uniform(0.0, tau)
            tree.wrong.by = (far * cos(angle), far * sin(angle))
            tree.wrong.until = self.now + self._chance.uniform(0.0, longest)
            again = self._chance.choice((0.0, 0.0, 600.0))  # now and then to and fro at once
            tree.wrong.next = tree.wrong.until + STEP + again
            self.wrong_fixes += 1
        return tree.wrong.by if self.now <= tree.wrong.until else (0.0, 0.0)

    def _start_again(self, tree: _Tree) -> None:
        """Begin a new run, with memory or with a list of the others, where the tree stands."""
        i = self._names.index(tree.name)
        tree.starts_again = False
        expects = tree.name in self._guests or self._chance.random() < 0.5
        right = self._right(i, tree.walker.place, expects=expects, known=tree.known)
        tree.walker.navigator = SharedNavigator(right, self._planner)
        tree.lived = LivedTime(2.0 * STEP)
        tree.walker.goal, tree.walker.moved_at = None, self.now
        self.starts += 1

    def _right(
        self, i: int, place: Point, *, expects: bool, known: set[str] | None = None
    ) -> RightOfWay:
        """Return a new run; who joins late is expected by nobody, and known once heard."""
        name, given = self._names[i], self._traffic[i]
        others = tuple(n for n in self._names if n != name and n not in self._guests)
        if expects:
            given = TrafficParameters(**(given.__dict__ | {'expected': others}))
        return RightOfWay(name, place, given, self._chance.getrandbits(64), sorted(known or ()))

    def _let_clock_go(self, tree: _Tree) -> None:
        tree.clock += STEP
        if self._chance.random() < 0.01:
            tree.clock += self._chance.choice((-1.0, 1.0)) * 10.0 ** self._chance.uniform(0.0, 6.0)
        tree.lived.update(tree.clock)

    # What all of it is like

    def _drawn(self) -> TrafficParameters:
        chance = self._chance
        return TrafficParameters(
            body=chance.uniform(0.5, 1.18),
            tolerance=chance.uniform(0.1, 0.3),
            margin=chance.uniform(0.0, 0.2),
            silent_after=chance.uniform(10.0, 90.0),
            listen=chance.uniform(0.0, 30.0),
        )

    def _network(self) -> RadioParameters:
        chance, calm = self._chance, self.parameters.calm
        return RadioParameters(
            loss=chance.uniform(0.0, 0.3 if calm else 0.9),
            delay=chance.uniform(0.0, 15.0) if calm else 10.0 ** chance.uniform(0.0, 2.08),
            doubled=chance.uniform(0.0, 0.2),
        )

    def _measure(self) -> None:
        for (a, one), (b, other) in combinations(zip(self.trees, self._traffic, strict=True), 2):
            apart = hypot(
                a.walker.place[0] - b.walker.place[0], a.walker.place[1] - b.walker.place[1]
            )
            promised = one.body + other.body + max(one.margin, other.margin)
            self.least_gap = min(self.least_gap, apart - promised)
