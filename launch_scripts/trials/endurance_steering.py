"""The steering planner over random platforms, commands and uneven steps; every limit measured.

    python launch_scripts/trials/endurance_steering.py --steps 1000000

Exits with 1 when a limit is exceeded by more than rounding, when the turrets do not share one
centre of rotation, or when a twist that is held is not made.
"""

from __future__ import annotations

import argparse
import statistics
import sys

from rich.progress import track

from agv_motion.simulation.trials.steering import SteeringTrial, Worst

STEPS = 1000
"""Of each trial, then it must settle."""


def main() -> None:
    """Run as many trials as the steps need and print the worst of all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--steps', type=int, default=1_000_000)
    parser.add_argument('--seed', type=int, default=0, help='of the first trial')
    asked = parser.parse_args()
    worst, turns = Worst(*[0.0] * 6), []
    for seed in track(range(asked.seed, asked.seed + max(asked.steps // STEPS, 1)), 'Steering'):
        trial = SteeringTrial(seed)
        worst = worst.with_(trial.steps(STEPS))
        wanted = trial.twist(trial.random.choice(['steady', 'about a turret']))
        time = trial.settle(wanted, 1e-6 * trial.limits.max_wheel_speed)
        turns.append(time * trial.limits.steering_rate)
    for name, value in zip(Worst._fields[:-1], worst[:-1], strict=True):
        print(f'{name.replace("_", " "):22} {value:.9f} of its limit at most')
    print(f'{"residual":22} {worst.residual:.1e} of the fastest wheel at most')
    print(
        f'a held twist is made within the time of {statistics.median(turns):.1f} rad of steering '
        f'(median), {max(turns):.1f} rad (worst), beside that of speeding up'
    )
    sys.exit(max(worst[:-1]) > 1.0 + 1e-7 or worst.residual > 1e-9)


if __name__ == '__main__':
    main()
