"""The strategies that remember: in turn to sun, to shade, and to the unknown.

The cycle of objectives over the memory of places; ties fall at random, from a seed. How a goal is
reached is a :class:`Reachability`: by the shortest path, or as the original installation did, only
in a straight line.
"""

from __future__ import annotations

import random
from math import hypot, isinf
from typing import TYPE_CHECKING

import numpy as np

from agv_motion.errors import GeometryError
from agv_motion.motion.behavior.goals.goal import Goal, Objective

if TYPE_CHECKING:
    from agv_motion.motion.behavior.cells import Mask
    from agv_motion.motion.behavior.goals.reachability import Reachability
    from agv_motion.motion.behavior.goals.strategy import GoalSetting
    from agv_motion.motion.behavior.memory import Memory
    from agv_motion.motion.navigation.polyline import Point

CYCLE = tuple(Objective)


class GoalSelector:
    """Remembers whose turn it is among the objectives; all else comes in."""

    first: Goal | None = None
    lasting = False

    def __init__(self, setting: GoalSetting, reachability: Reachability) -> None:
        """Begin with the sun."""
        assert setting.floor is not None, 'a strategy that remembers needs a zone'
        self._setting, self._floor = setting, setting.floor
        self._reachability = reachability
        self._random = random.Random(setting.seed)  # noqa: S311 - equals, not secrets
        self._turn = 0
        self.refusals: list[str] = []

    def next_goal(self, memory: Memory | None, here: Point, now: float) -> Goal | None:
        """Return the next goal of the cycle; see :meth:`GoalStrategy.next_goal`.

        An objective that is fulfilled where the tree stands passes its turn on. One that no path
        leads to does so as well, and counts as a failure.
        """
        assert memory is not None
        open_cells = memory.cells.part == memory.cells.part_at(*here)
        self.refusals = []
        satisfied = 0
        while len(self.refusals) < self._setting.attempts and satisfied < len(CYCLE):
            objective = CYCLE[self._turn]
            self._turn = (self._turn + 1) % len(CYCLE)
            goal = self.best(objective, now, memory, open_cells)
            arrival = self._setting.arrival(objective)
            if goal is None or hypot(goal.x - here[0], goal.y - here[1]) < arrival:
                satisfied += 1
                continue
            try:
                self._reachability.require(self._floor, here, goal.place)
            except GeometryError as error:
                self.refusals.append(f'{goal.reason}: {error}')
                open_cells &= ~self._around(memory, goal)
                satisfied = 0
            else:
                return goal
        return None

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
        cell = divmod(int(equals[self._random.randrange(equals.size)]), memory.cells.part.shape[1])
        return _goal(objective, time, memory, cell)

    def _around(self, memory: Memory, goal: Goal) -> Mask:
        away = np.hypot(memory.cells.x[None, :] - goal.x, memory.cells.y[:, None] - goal.y)
        near: Mask = away < self._reachability.retry_distance
        return near


def _goal(objective: Objective, time: float, memory: Memory, cell: tuple[int, int]) -> Goal:
    """Return a cell as a goal, with its reason in words."""
    x, y = float(memory.cells.x[cell[1]]), float(memory.cells.y[cell[0]])
    place = f'({x:.1f}, {y:.1f})'
    if objective is Objective.UNKNOWN:
        visited = float(memory.visited_at[cell])
        if isinf(visited):
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
