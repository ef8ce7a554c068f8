"""What several trees have done, read back from their bag: columns and numbers."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from rich.table import Table

from agv_motion.bag.message_objects import decoded
from agv_motion.report.stamped_columns import pose_columns

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from agv_motion.bag.reader import BagReader
    from agv_motion.model.footprint import Footprint
    from agv_motion.motion.navigation.reservations.parameters import TrafficParameters

    Array = NDArray[np.float64]

DOINGS = ('walks', 'gives way', 'waits', 'rests')
"""What a tree may do."""


class RecordedWalk(NamedTuple):
    """The walk of one tree; times in seconds since the start of the bag."""

    name: str
    time: Array
    """(n,) of the path"""
    path: Array
    """(2, n) true place [m]"""
    goals: list[tuple[float, float, float]]
    """time, x and y [m] of each"""
    doings: list[tuple[float, str]]
    """from when on the tree did what, of `DOINGS`"""
    heading: Array
    """(n,) true [rad]"""
    footprints: list[Footprint] | None = None
    """of the tree at the start and at the end; None: only its rim is known"""

    def distance(self) -> float:
        """Return the length of the way [m]."""
        return float(np.hypot(*np.diff(self.path)).sum())

    def spans(self) -> list[tuple[float, float, str]]:
        """Return beginning, length and what, of all that the tree did."""
        ends = [*(begin for begin, _ in self.doings[1:]), float(self.time[-1])]
        return [
            (begin, end - begin, what)
            for (begin, what), end in zip(self.doings, ends, strict=False)
        ]

    def share(self, doing: str) -> float:
        """Return the share of the time that the tree spent on ``doing``."""
        spent = sum(length for _, length, what in self.spans() if what == doing)
        return spent / max(float(self.time[-1]), 1e-9)


def doing_of(state: str) -> str:
    """Return which of `DOINGS` the state of a tree, in words, is."""
    if ': gives way' in state:
        return 'gives way'
    if ': waits' in state or ': listens' in state:
        return 'waits'
    return 'walks' if state.startswith(('walking', 'turning', 'returning')) else 'rests'


def read_walks(bag: BagReader, names: Sequence[str]) -> list[RecordedWalk]:
    """Read the bag back."""
    truths = pose_columns(bag, [f'/{name}/ground_truth' for name in names])
    goals: dict[str, list[tuple[float, float, float]]] = {name: [] for name in names}
    doings: dict[str, list[tuple[float, str]]] = {name: [] for name in names}
    told = {f'/{name}/{topic}' for name in names for topic in ('goal', 'state')}
    for message, content in decoded(bag, [topic for topic in bag.topics if topic in told]):
        _, name, topic = message.connection.topic.split('/')
        time = (message.stamp - bag.start) * 1e-9
        if topic == 'goal':
            goals[name].append((time, content.pose.position.x, content.pose.position.y))
        else:
            doings[name].append((time, doing_of(content.data)))
    return [
        RecordedWalk(
            name,
            truth.stamp - bag.start * 1e-9,
            truth.pose[:2],
            goals[name],
            doings[name],
            truth.pose[2],
        )
        for name, truth in zip(names, truths, strict=True)
    ]


def gaps(walks: Sequence[RecordedWalk], body: float) -> tuple[Array, dict[str, Array]]:
    """Return times [s], and between each two trees the distance from rim to rim then [m].

    Args:
        walks: Of all trees.
        body: Rim of a tree from its centre [m].

    """
    begin, end = max(w.time[0] for w in walks), min(w.time[-1] for w in walks)
    times = np.arange(begin, max(end, begin + 0.5), 0.5)  # one at least, of whatever walk
    there = {
        walk.name: np.array([np.interp(times, walk.time, line) for line in walk.path])
        for walk in walks
    }
    return times, {
        f'{a} and {b}': np.hypot(*(there[a] - there[b])) - 2.0 * body
        for a, b in combinations(there, 2)
    }


def summary(walks: Sequence[RecordedWalk]) -> Table:
    """Return the figures of all walks as a table."""
    table = Table(title='The walks', title_justify='left', box=None)
    for column in ('tree', 'walked', 'goals', *DOINGS):
        table.add_column(column, justify='left' if column == 'tree' else 'right')
    for walk in walks:
        shares = [f'{100.0 * walk.share(doing):.0f} %' for doing in DOINGS]
        table.add_row(walk.name, f'{walk.distance():.1f} m', str(len(walk.goals)), *shares)
    return table


def nearest(walks: Sequence[RecordedWalk], traffic: TrafficParameters) -> str:
    """Return in words which two trees came nearest to each other, and how near."""
    _, between = gaps(walks, traffic.body)
    pair = min(between, key=lambda pair: between[pair].min())
    return (
        f'{pair} came nearest: {between[pair].min():.2f} m from rim to rim; '
        f'{traffic.margin:.2f} m are allowed'
    )
