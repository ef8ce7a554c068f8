"""Where the tree goes next: in turn to sun, to shade, and to the unknown.

The cycle of wishes over the memory of places; ties fall at random, from a seed. How a goal is
reached is a strategy: by the shortest path, or as the ancestor did, only in a straight line.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from enum import Enum
from math import hypot
from typing import TYPE_CHECKING, Annotated, NamedTuple, Protocol

import numpy as np

from agv_motion.errors import GeometryError
from agv_motion.motion.behavior.memory import NEVER
from agv_motion.parameters import Spec, check

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.motion.behavior.memory import Mask, Memory
    from agv_motion.motion.navigation.path_planner import PathPlanner, Point


class Objective(Enum):
    """What the tree seeks, in the order of the cycle."""

    SUN = 'highest remembered sap flow'
    SHADE = 'lowest remembered sap flow'
    UNKNOWN = 'longest unvisited'


CYCLE = tuple(Objective)


class Goal(NamedTuple):
    """A place to go to, and why."""

    x: float
    """[m]"""
    y: float
    """[m]"""
    reason: str
    """in words"""
    objective: Objective | None = None
    """None: asked for from outside"""

    @property
    def place(self) -> Point:
        """Where it is [m]."""
        return self.x, self.y


@dataclass(frozen=True)
class GoalParameters:
    """How goals are chosen."""

    strategy: Annotated[
        str,
        Spec(
            'fixed: the parameter goal; memory: in turn the highest and lowest remembered sap flow '
            'and the longest unvisited place; straight: those of them to which a straight line '
            'leads, as the ancestor did',
            choices=('fixed', 'memory', 'straight'),
        ),
    ] = 'fixed'
    seed: Annotated[int, Spec('of the choice among equals', '1', (0, 2**31))] = 1
    attempts: Annotated[
        int, Spec('goals without a way before the tree stays and turns', '1', (1, 100))
    ] = 9
    retry_after: Annotated[
        float, Spec('how long it then stays before it tries again', 's', (0.1, 3600.0))
    ] = 10.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class Strategy(Protocol):
    """How goals are reached."""

    retry_distance: float
    """[m] how far from a goal without a path the next attempt of the same decision stays"""

    def path(self, paths: PathPlanner, start: Point, goal: Point) -> list[Point]:
        """Return the corners of a path; raise a `GeometryError` if there is none."""


class ShortestWay:
    """Round every corner: what is walkable and connected is reached."""

    retry_distance = 2.0

    def path(self, paths: PathPlanner, start: Point, goal: Point) -> list[Point]:
        """Return the shortest path."""
        return paths.path(start, goal)


class StraightLine:
    """As the ancestor: straight or not at all, and the next attempt may ask for the same again."""

    retry_distance = 0.0

    def path(self, paths: PathPlanner, start: Point, goal: Point) -> list[Point]:
        """Return the straight line.

        Raises:
            GeometryError: It leaves the walkable floor.

        """
        path = paths.path(start, goal)
        if len(path) > 2:
            msg = f'no straight line leads to ({goal[0]:.2f}, {goal[1]:.2f})'
            raise GeometryError(msg)
        return path


class Choice(NamedTuple):
    """What has come of a search for the next goal."""

    goal: Goal | None
    """None: no goal has a path"""
    path: list[Point]
    """its corners; empty without a goal"""
    failures: list[str]
    """why the goals before it were not taken"""


class GoalSelector:
    """Remembers whose turn it is among the wishes; all else comes in."""

    def __init__(self, parameters: GoalParameters, strategy: Strategy | None = None) -> None:
        """Begin with the sun."""
        self.parameters = parameters
        self._strategy = strategy or (
            StraightLine() if parameters.strategy == 'straight' else ShortestWay()
        )
        self._random = random.Random(parameters.seed)  # noqa: S311 - equals, not secrets
        self._turn = 0

    def next(
        self,
        time: float,
        start: Point,
        memory: Memory,
        paths: PathPlanner,
        arrival: Callable[[Objective], float],
    ) -> Choice:
        """Return the next goal of the cycle, and the path to it.

        A wish that is fulfilled where the tree stands passes its turn on. One that no way leads to
        does so as well, and counts as a failure.

        Args:
            time: Now [s].
            start: Where the tree is [m].
            memory: What it remembers.
            paths: The paths there are.
            arrival: How near each wish counts as fulfilled [m].

        """
        open_cells = memory.part == memory.part_at(*start)
        failures: list[str] = []
        satisfied = 0
        while len(failures) < self.parameters.attempts and satisfied < len(CYCLE):
            objective = CYCLE[self._turn]
            self._turn = (self._turn + 1) % len(CYCLE)
            goal = self.best(objective, time, memory, open_cells)
            if goal is None or hypot(goal.x - start[0], goal.y - start[1]) < arrival(objective):
                satisfied += 1
                continue
            try:
                return Choice(goal, self._strategy.path(paths, start, goal.place), failures)
            except GeometryError as error:
                failures.append(f'{goal.reason}: {error}')
                open_cells &= ~self._around(memory, goal)
                satisfied = 0
        return Choice(None, [], failures)

    def best(self, objective: Objective, time: float, memory: Memory, cells: Mask) -> Goal | None:
        """Return the place among ``cells`` that fulfils ``objective`` most; None if none does."""
        if objective is Objective.UNKNOWN:
            values = np.where(cells, memory.visited_at, np.inf)
            best = values == values.min() if cells.any() else np.zeros_like(cells)
        else:
            known = cells & memory.felt
            flow = memory.remembered(time) * (1.0 if objective is Objective.SUN else -1.0)
            values = np.where(known, flow, -np.inf)
            best = known & (values == values.max())
        equals = np.flatnonzero(best)
        if not equals.size:
            return None
        cell = divmod(int(equals[self._random.randrange(equals.size)]), memory.part.shape[1])
        return _goal(objective, time, memory, cell)

    def _around(self, memory: Memory, goal: Goal) -> Mask:
        away = np.hypot(memory.x[None, :] - goal.x, memory.y[:, None] - goal.y)
        near: Mask = away < self._strategy.retry_distance
        return near


def _goal(objective: Objective, time: float, memory: Memory, cell: tuple[int, int]) -> Goal:
    """Return a cell as a goal, with its reason in words."""
    x, y = float(memory.x[cell[1]]), float(memory.y[cell[0]])
    place = f'({x:.1f}, {y:.1f})'
    if objective is Objective.UNKNOWN:
        visited = float(memory.visited_at[cell])
        if visited == NEVER:
            return Goal(x, y, f'never visited: {place}', objective)
        return Goal(
            x, y, f'{objective.value}: {place}, last visited {ago(time - visited)}', objective
        )
    flow = float(memory.remembered(time)[cell])
    felt = ago(time - float(memory.felt_at[cell]))
    return Goal(x, y, f'{objective.value} {flow:.2f} at {place}, felt {felt}', objective)


def ago(seconds: float) -> str:
    """Return a time past in words.

    >>> ago(3 * 3600.0)
    '3 h ago'
    """
    for unit, name in ((86400.0, 'days'), (3600.0, 'h'), (60.0, 'min')):
        count = int(seconds / unit)
        if count >= (2 if name == 'days' else 1):
            return f'{count} {name} ago'
    return 'just now'
