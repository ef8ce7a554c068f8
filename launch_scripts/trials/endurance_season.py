"""Days of one to five trees in zones of all kinds, by the minds that the nodes have.

    python launch_scripts/trials/endurance_season.py --days 1000

Seeds, zones, weather, errors of position, losses and outages of the network vary. Exits with 1
when a tree leaves its zone, two come nearer than they may, or one stands for over 30 minutes while
it has somewhere to go.
"""

from __future__ import annotations

import argparse
import itertools
import multiprocessing
import os
import sys

from rich.console import Console
from rich.progress import track
from rich.table import Table

from agv_motion.simulation.trials.season import Season, SeasonParameters, Tally
from agv_motion.simulation.trials.season_zones import MOST_TREES

MOST_STAND = 1800.0
"""[s]"""


def spend(given: SeasonParameters) -> tuple[SeasonParameters, Tally]:
    """Return a season and what came of it."""
    return given, Season(given).run()


def seasons(days: int, each: int, seed: int) -> list[SeasonParameters]:
    """Return seasons of ``each`` days that make ``days``, kinds and numbers of trees in turn."""
    casts = [(kind, n) for kind, most in MOST_TREES.items() for n in range(1, most + 1)]
    chosen = itertools.islice(itertools.cycle(casts), max(-(-days // each), 1))
    return [
        SeasonParameters(kind=kind, trees=trees, days=each, seed=seed + i)
        for i, (kind, trees) in enumerate(chosen)
    ]


def kept(tally: Tally) -> bool:
    """Return whether all held that must."""
    inside, apart = tally.least_inside >= 0.0, tally.least_gap >= 0.0
    return inside and apart and tally.longest_stand <= MOST_STAND


def report(outcomes: list[tuple[SeasonParameters, Tally]]) -> Table:
    """Return one row for each kind of zone and number of trees, the worst of its seasons."""
    table = Table(title='The worst of all seasons', title_justify='left')
    for column in (
        'zone', 'trees', 'days', 'walked [km]', 'goals', 'edge spared [m]', 'gap spared [m]',
        'stood [min]', 'covered',
    ):  # fmt: skip
        table.add_column(column)
    casts = sorted({(given.kind, given.trees) for given, _ in outcomes})
    for kind, trees in casts:
        tallies = [tally for given, tally in outcomes if (given.kind, given.trees) == (kind, trees)]
        table.add_row(
            kind, str(trees), str(sum(t.days for t in tallies)),
            f'{sum(t.walked for t in tallies) / 1000.0:.1f}', str(sum(t.goals for t in tallies)),
            f'{min(t.least_inside for t in tallies):.3f}',
            f'{min(t.least_gap for t in tallies):.3f}',
            f'{max(t.longest_stand for t in tallies) / 60.0:.1f}',
            f'{min(t.coverage[-1] for t in tallies):.3f}',
        )  # fmt: skip
    return table


def main() -> None:
    """Spend the days that are asked for."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument('--days', type=int, default=1000, help='of all seasons together')
    parser.add_argument('--each', type=int, default=20, help='days of one season')
    parser.add_argument('--seed', type=int, default=1, help='of the first season')
    parser.add_argument('--workers', type=int, default=os.cpu_count())
    asked = parser.parse_args()
    wanted = seasons(asked.days, asked.each, asked.seed)
    with multiprocessing.Pool(asked.workers) as pool:
        outcomes = list(track(pool.imap_unordered(spend, wanted), 'Seasons', len(wanted)))
        Console(width=None if sys.stdout.isatty() else 120).print(report(outcomes))
        for given, tally in outcomes:
            if not kept(tally):
                print(f'not kept: {given.kind}, {given.trees} trees, seed {given.seed}: {tally}')
    sys.exit(not all(kept(tally) for _, tally in outcomes))


if __name__ == '__main__':
    main()
