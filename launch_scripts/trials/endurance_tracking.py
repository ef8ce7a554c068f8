"""Hundreds of random trajectories, driven with slip, lag and a noisy pose: all arrive, near enough.

    python launch_scripts/trials/endurance_tracking.py --trajectories 200

Exits with 1 when one is lost, or strays by more than 2 cm (root mean square) from its Ghost.
"""

from __future__ import annotations

import argparse
import sys

from rich.progress import track

from agv_motion.simulation.trials.tracking import TrackingTrial, TrackingTrialParameters
from agv_motion.trajectory.follower_parameters import FollowerParameters
from agv_motion.trajectory.follower_state import FollowerState

LIMIT = 0.02
"""[m] root mean square of the distance between robot and Ghost"""


def drive(law: str, trajectories: int) -> bool:
    """Drive them all and print how it went; return whether all kept their promise."""
    trials = []
    for seed in track(range(trajectories), law):
        follower = FollowerParameters(law=law)
        trial = TrackingTrial(TrackingTrialParameters(seed=seed, follower=follower))
        trials.append((trial.run(), trial.rms(), max(trial.deviations()), seed))
    lost = [seed for state, *_, seed in trials if state is not FollowerState.ARRIVED]
    overall = (sum(rms**2 for _, rms, _, _ in trials) / trajectories) ** 0.5
    worst = max(trials, key=lambda trial: trial[1])
    print(
        f'{law}: {trajectories} trajectories, lost {lost or "none"}; rms over all '
        f'{overall * 100:.2f} cm, of the worst (seed {worst[3]}) {worst[1] * 100:.2f} cm; '
        f'never more than {max(trial[2] for trial in trials) * 100:.2f} cm away'
    )
    return not lost and worst[1] < LIMIT


def main() -> None:
    """Drive with both laws of a differential robot."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--trajectories', type=int, default=200)
    given = parser.parse_args()
    kept = [drive(law, given.trajectories) for law in ('kanayama', 'ramsete')]
    sys.exit(0 if all(kept) else 1)


if __name__ == '__main__':
    main()
