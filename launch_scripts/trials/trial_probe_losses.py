"""A season in which probes fail a hundred times: no motion by noise, rest as the ladder says.

    python launch_scripts/trials/trial_probe_losses.py
    python launch_scripts/trials/trial_probe_losses.py --days 120 --failures 100 --seeds 5

Wires are cut, heaters stop, inputs hang free and show noise on any level, values go beyond belief,
for ten minutes to a day each. Exits with 1 where a reading of such a probe was believed after it
could be known, or the tree rested earlier or moved later than its ladder of loss says.
"""

from __future__ import annotations

import argparse
import sys

from rich.console import Console
from rich.table import Table

from agv_motion.simulation.trials.probe_losses import LossTrialParameters, trial


def main() -> int:
    """Run the seasons and tell of each."""
    parser = argparse.ArgumentParser(description=__doc__.split('\n', 1)[0])
    parser.add_argument('--days', type=float, default=120.0)
    parser.add_argument('--failures', type=int, default=100)
    parser.add_argument('--seeds', type=int, default=3)
    asked = parser.parse_args()
    table = Table(
        'seed', 'failures', 'by noise', 'rested early', 'moved late', 'rested [h]',
        'of at most [h]', 'largest error of what was held', title='Losses of probes',
    )  # fmt: skip
    good = True
    for seed in range(1, asked.seeds + 1):
        tally = trial(LossTrialParameters(days=asked.days, failures=asked.failures, seed=seed))
        good &= not (tally.by_noise or tally.early or tally.late)
        table.add_row(
            str(seed), *map(str, tally[:4]), f'{tally.rested:.1f}', f'{tally.allowed:.1f}',
            f'{tally.error:.2f}',
        )  # fmt: skip
    Console().print(table)
    return 0 if good else 1


if __name__ == '__main__':
    sys.exit(main())
