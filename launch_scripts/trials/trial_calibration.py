"""Do the 95 % intervals of a calibration hold the truth in 95 of 100 drives?

    python launch_scripts/trials/trial_calibration.py --drives 200

Every base, with and without headings in the references, with and without somebody who carries the
robot away. Exits with 1 where less than 93 or more than 97 in 100 true values lie within.
"""

from __future__ import annotations

import argparse
import sys
from itertools import product

from agv_motion.simulation.trials.calibration import BASES, coverage

LEAST, MOST = 0.93, 0.97


def main() -> None:
    """Run all and print a row each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--drives', type=int, default=200, help='of each kind')
    parser.add_argument('--first', type=int, default=0, help='seed of the first')
    asked = parser.parse_args()
    seeds, failed = range(asked.first, asked.first + asked.drives), 0
    print('base          headings  carried   within   of       share   deviation  misfit  cuts')
    for base, heading, carried in product(BASES, (True, False), (False, True)):
        found = coverage(base, seeds, heading=heading, carried=carried)
        share = found.held / found.told
        failed += not LEAST <= share <= MOST
        print(
            f'{base:12}  {heading!s:8}  {carried!s:8}  {found.held:6}   {found.told:6}   '
            f'{share:.3f}   {found.deviation:6.2f}   {found.misfit:9.2f}  {found.cuts:4}',
            flush=True,
        )
    sys.exit(failed > 0)


if __name__ == '__main__':
    main()
