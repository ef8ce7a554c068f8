"""The fusion over simulated days: UWB with outliers, multipath, delays and 5-minute drop-outs.

    python launch_scripts/trials/endurance_fusion.py --hours 24 --seeds 3

Exits with 1 when the position errs by more than 5 of its own standard deviations for more than
one second in a thousand (with multipath, which nobody tells the filter of, one in fifty).
"""

from __future__ import annotations

import argparse
import sys
from math import hypot, sqrt

from agv_motion.odometry.fusion_report import FixVerdict, FusionState
from agv_motion.simulation.trials.omni import OmniTrial, TrialParameters
from agv_motion.simulation.uwb import UwbParameters

BOUND = 5.0
"""Standard deviations by which the position may err."""


def day(seed: int, hours: float, *, multipath: bool) -> bool:
    """Drive for some hours and print how it went; return whether it kept to its bounds."""
    uwb = UwbParameters(
        latency=1.0,
        outlier_share=0.1,
        dropout_interval=1800.0,
        dropout_duration=300.0,
        multipath_interval=900.0 if multipath else 0.0,
    )
    trial = OmniTrial(TrialParameters(seed=seed, rate=10.0, uwb=uwb))
    squares, worst, beyond, tracked = 0.0, 0.0, 0, 0
    for i in range(round(hours * 36000)):
        trial.step()
        health = trial.fusion.health() if i % 10 == 0 else None
        estimate = trial.fusion.estimate() if health else None
        if health is None or estimate is None:
            continue
        pose = trial.robot.pose
        error = hypot(estimate.pose.x - pose.x, estimate.pose.y - pose.y)
        beyond += error > BOUND * health.position_deviation
        worst = max(worst, error)
        if health.state is FusionState.TRACKING:
            squares, tracked = squares + error * error, tracked + 1
    verdicts = trial.fusion.health().verdicts
    print(
        f'seed {seed}: {hours:g} h, RMS error {sqrt(squares / tracked):.3f} m while tracking, '
        f'worst {worst:.2f} m in drop-outs, {beyond} s beyond {BOUND:g} sigma, '
        f'{verdicts[FixVerdict.REJECTED]} fixes rejected, '
        f'{verdicts[FixVerdict.KIDNAPPED]} new starts'
    )
    return beyond < (0.02 if multipath else 0.001) * hours * 3600


def main() -> None:
    """Run the days that are asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--hours', type=float, default=24.0)
    parser.add_argument('--seeds', type=int, default=3)
    parser.add_argument('--multipath', action='store_true')
    asked = parser.parse_args()
    kept = [day(seed, asked.hours, multipath=asked.multipath) for seed in range(asked.seeds)]
    sys.exit(not all(kept))


if __name__ == '__main__':
    main()
