"""Losses of probes over some days; the long form is launch_scripts/trials/trial_probe_losses.py."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pytest

from agv_motion.probe.loss import LossParameters
from agv_motion.simulation.trials.probe_losses import (
    LADDER,
    LossTrialParameters,
    ProbeFault,
    failures_of,
    trial,
)

SHORT = LossTrialParameters(days=12.0, failures=10, step=600.0, seed=3)


def test_failures_come_one_after_another_and_are_of_all_kinds():
    found = failures_of(LossTrialParameters())
    assert len(found) == 100
    assert {failure.fault for failure in found} == set(ProbeFault)
    assert all(a.end + 7200.0 <= b.begin for a, b in pairwise(found))
    assert all(600.0 <= each.end - each.begin <= 86400.0 for each in found)


@pytest.mark.parametrize(
    'ladder', [LADDER, LossParameters(), replace(LADDER, hold=3600.0, trend=0.0, climatology=0.0)]
)
def test_no_motion_by_noise_and_rest_only_as_the_ladder_says(ladder):
    tally = trial(replace(SHORT, loss=ladder))
    assert (tally.failures, tally.by_noise, tally.early, tally.late) == (10, 0, 0, 0)
    assert 0.0 < tally.rested <= tally.allowed
    assert tally.error < 0.7


def test_two_of_three_never_rest_for_one():
    tally = trial(replace(SHORT, loss=replace(LADDER, enough=2)))
    assert (tally.by_noise, tally.rested) == (0, 0.0)
