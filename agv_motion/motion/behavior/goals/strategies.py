"""The strategies of goals by name: the one place that knows them all."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, NamedTuple

from agv_motion.motion.behavior.goals.fixed_goal import FixedGoal
from agv_motion.motion.behavior.goals.goal_selector import GoalSelector
from agv_motion.motion.behavior.goals.reachability import ShortestPath, StraightLine
from agv_motion.parameters import Spec, check

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.motion.behavior.goals.strategy import GoalSetting, GoalStrategy


class StrategyKind(NamedTuple):
    """One kind of strategy."""

    text: str
    """what it goes to, for whoever chooses one"""
    build: Callable[[GoalSetting], GoalStrategy]
    remembers: bool = True
    """whether it chooses by the memory of places, and so needs a zone"""


STRATEGIES = {
    'fixed': StrategyKind('the parameter goal', FixedGoal, remembers=False),
    'memory': StrategyKind(
        'in turn the highest and lowest remembered sap flow and the longest unvisited place',
        lambda setting: GoalSelector(setting, ShortestPath()),
    ),
    'straight': StrategyKind(
        'those of them to which a straight line leads, as the original installation did',
        lambda setting: GoalSelector(setting, StraightLine()),
    ),
}
"""A strategy is added here, and nowhere else but in its own file."""


@dataclass(frozen=True)
class GoalParameters:
    """How goals are chosen."""

    strategy: Annotated[
        str,
        Spec(
            '; '.join(f'{name}: {kind.text}' for name, kind in STRATEGIES.items()),
            choices=tuple(STRATEGIES),
        ),
    ] = 'fixed'
    seed: Annotated[int, Spec('of the choice among equals', '1', (0, 2**31))] = 1
    attempts: Annotated[
        int, Spec('goals without a path before the tree stays and turns', '1', (1, 100))
    ] = 9
    retry_after: Annotated[
        float, Spec('time for which it then stays before it tries again', 's', (0.1, 3600.0))
    ] = 10.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    @property
    def kind(self) -> StrategyKind:
        """What the strategy is."""
        return STRATEGIES[self.strategy]
