"""Episodes of trees that share a zone over the worst of networks: no two ever come too near.

    python launch_scripts/trials/endurance_traffic.py --episodes 10000
    python launch_scripts/trials/endurance_traffic.py --seconds 600 --workers 1

Sizes, margins, zones and networks vary (delays to 120 s, losses to 90 %, doubled words); trees
start again with and without memory, park, join late, believe for seconds that they are elsewhere,
and their clocks differ and leap. Every fifth episode is calm (delays to 15 s, losses to 30 %) and
longer; there nobody may stand for over 30 minutes. Exits with 1 when rims come nearer than
promised, or one stands for longer.
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import sys
import time

from agv_motion.simulation.trials.traffic_episode import (
    Episode,
    EpisodeOutcome,
    EpisodeParameters,
)

MOST_STAND = 1800.0
"""[s]"""


def episode(seed: int) -> EpisodeParameters:
    """Return what the episode of a seed is."""
    calm = seed % 5 == 0
    return EpisodeParameters(seed=seed, seconds=5400.0 if calm else 1800.0, calm=calm)


def play(seed: int) -> tuple[EpisodeParameters, EpisodeOutcome]:
    """Return an episode and what came of it."""
    given = episode(seed)
    return given, Episode(given).run()


def kept(given: EpisodeParameters, outcome: EpisodeOutcome) -> bool:
    """Return whether all held that must."""
    walks = not given.calm or outcome.longest_stand <= MOST_STAND
    return outcome.least_gap >= 0.0 and walks


def main() -> None:
    """Play the episodes that are asked for, or as many as the time allows."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument('--episodes', type=int, default=10_000)
    parser.add_argument('--seconds', type=float, default=float('inf'), help='stop after so long')
    parser.add_argument('--seed', type=int, default=1, help='of the first episode')
    parser.add_argument('--workers', type=int, default=os.cpu_count())
    asked = parser.parse_args()
    seeds = range(asked.seed, asked.seed + asked.episodes)
    end, failed, outcomes = time.monotonic() + asked.seconds, 0, []
    with multiprocessing.Pool(asked.workers) as pool:
        for given, outcome in pool.imap_unordered(play, seeds):
            outcomes.append((given, outcome))
            if not kept(given, outcome):
                failed += 1
                print(f'not kept: {given}: {outcome}', flush=True)
            if len(outcomes) % 100 == 0:
                print(f'{len(outcomes)} episodes, {failed} not kept', flush=True)
            if time.monotonic() > end:
                pool.terminate()
                break
    every = [outcome for _, outcome in outcomes]
    stands = [outcome.longest_stand for given, outcome in outcomes if given.calm]
    print(
        f'{len(every)} episodes: {sum(o.starts for o in every)} starts, '
        f'{sum(o.parkings for o in every)} parkings, {sum(o.wrong_fixes for o in every)} wrong '
        f'fixes, {sum(o.arrivals for o in every)} arrivals; '
        f'least gap {min(o.least_gap for o in every):.3f} m beyond what is promised; '
        f'longest stand in calm ones {max(stands, default=0.0) / 60.0:.1f} min; {failed} not kept'
    )
    sys.exit(failed > 0)


if __name__ == '__main__':
    main()
