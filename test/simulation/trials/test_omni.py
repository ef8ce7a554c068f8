"""The trial: the robot roams its zone, the same for the same seed."""

from __future__ import annotations

from agv_motion.simulation.trials.omni import OmniTrial, TrialParameters


def positions(seed):
    trial, found = OmniTrial(TrialParameters(seed=seed, rate=10.0)), []
    for _ in range(1200):
        trial.step()
        found.append(trial.robot.pose)
    return found


def test_it_stays_in_its_zone_and_gets_about():
    found = positions(1)
    assert all(-1.0 < pose.x < 21.0 and -1.0 < pose.y < 16.0 for pose in found)
    assert max(pose.x for pose in found) - min(pose.x for pose in found) > 5.0


def test_a_seed_belongs_to_its_drive():
    assert positions(1) == positions(1) != positions(2)


def test_time_and_fixes_come_at_their_rates():
    trial, count = OmniTrial(TrialParameters(rate=10.0)), 0
    for _ in range(100):
        trial.step()
        count += len(trial.fixes)
    assert trial.time == 10.0
    assert count == 10
