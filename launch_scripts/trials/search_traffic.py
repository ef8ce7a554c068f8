"""Every order of events between two and three trees that share a zone: does floor stay apart?

    python launch_scripts/trials/search_traffic.py --states 1000000

Each row is a search from another beginning, over the objects that the nodes have; breadth first, up
to a number of different states. Exits with 1 where two trees come to hold the same floor, and
prints the events that lead there.
"""

from __future__ import annotations

import argparse
import sys
import time

from agv_motion.simulation.trials.traffic_search import EVENTS, Search, SearchParameters

BEGINNINGS = {
    'two, anything happens': {'cells': (0, 3), 'events': EVENTS},
    'two, silence': {'cells': (0, 3), 'rounds': 2, 'messages': 6, 'events': ('silence',)},
    'two, near, anything but silence': {
        'cells': (0, 2), 'rounds': 2, 'events': ('restart', 'park', 'withdraw'),
    },
    'two, near, late and lost words': {'cells': (0, 2), 'rounds': 2, 'messages': 8, 'events': ()},
    'two, both parked': {'cells': (0, 2), 'parked': True, 'messages': 6, 'events': ('park',)},
    'two, one just started again': {
        'cells': (0, 2), 'restarted': True, 'rounds': 3, 'events': ('restart',), 'runs': 3,
    },
    'three, late and lost words': {
        'cells': (0, 2, 4), 'rounds': 2, 'late': 1, 'messages': 4, 'requested': True, 'events': (),
    },
    'three, all parked, set out at once': {
        'cells': (0, 2, 4), 'parked': True, 'requested': True, 'late': 1, 'messages': 4,
        'events': (),
    },
    'two, wrong fixes': {
        'cells': (1, 2), 'rounds': 2, 'late': 1, 'events': ('wrong fix', 'withdraw'),
    },
    'two, wrong fixes, restarts, silence': {
        'cells': (0, 2), 'rounds': 2, 'events': ('wrong fix', 'restart', 'silence'),
    },
}  # fmt: skip


def main() -> None:
    """Search from every beginning."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument('--states', type=int, default=100_000, help='of each search at most')
    asked = parser.parse_args()
    failed = False
    for name, given in BEGINNINGS.items():
        begun = time.monotonic()
        found = Search(SearchParameters(states=asked.states, **given)).run()
        print(
            f'{name}: {found.states} states{" (all)" if found.complete else ""}, '
            f'{found.granted} times floor was taken, {time.monotonic() - begun:.0f} s',
            flush=True,
        )
        for event in found.breach:
            print(f'    {event}')
        failed |= bool(found.breach)
    sys.exit(failed)


if __name__ == '__main__':
    main()
