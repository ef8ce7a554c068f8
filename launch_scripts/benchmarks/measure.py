"""What the benchmarks share: one row of the table, the table, and the median time of a call."""

from __future__ import annotations

import statistics
import sys
import time
from typing import TYPE_CHECKING, Any, NamedTuple

from rich.console import Console
from rich.table import Table

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable


class Row(NamedTuple):
    """One comparison; times in seconds."""

    what: str
    ours: float
    peer: str = ''
    theirs: float = 0.0
    target: str = ''
    plain: bool = False
    """whether ``ours`` is a number and no time"""


def per_call(
    act: Callable[[], Any], calls: int = 2000, rounds: int = 15,
    clock: Callable[[], float] = time.perf_counter,
) -> float:  # fmt: skip
    """Return the median time of one call [s]."""
    times = []
    for _ in range(rounds):
        begin = clock()
        for _ in range(calls):
            act()
        times.append((clock() - begin) / calls)
    return statistics.median(times)


def shown(seconds: float) -> str:
    """Return a time in the unit that suits it."""
    for unit, factor in (('s', 1.0), ('ms', 1e3), ('us', 1e6)):
        if seconds * factor >= 1.0:
            return f'{seconds * factor:.2f} {unit}'
    return f'{seconds * 1e9:.2f} ns'


def show(rows: Iterable[Row]) -> None:
    """Print the table."""
    table = Table(title='Ours beside the peer; medians', title_justify='left')
    for column in ('what', 'ours', 'peer', 'theirs', 'ours / theirs', 'target'):
        table.add_column(column)
    for row in rows:
        ours = f'{row.ours:.3g}' if row.plain else shown(row.ours)
        theirs = f'{row.theirs:.3g}' if row.plain else shown(row.theirs)
        beside = (theirs, f'{row.ours / row.theirs:.2f}') if row.peer else ('', '')
        table.add_row(row.what, ours, row.peer, *beside, row.target)
    Console(width=None if sys.stdout.isatty() else 130).print(table)
