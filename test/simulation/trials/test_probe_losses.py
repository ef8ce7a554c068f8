"""Losses of probes over some days; the long form is launch_scripts/trials/trial_probe_losses.py."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import pytest

from agv_motion.probe.loss import LossParameters
from agv_motion.simulation.trials import probe_losses
from agv_motion.simulation.trials.probe_losses import (
    BEGIN,
    DAY,
    LADDER,
    PROBES,
    Failure,
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


@pytest.mark.parametrize(
    ('side', 'first', 'length', 'level'), [(0, 0.0, 600.0, 6.0), (1, 3600.0, 75_600.0, 20.0)]
)
def test_when_probes_fail_by_hand(monkeypatch, side, first, length, level):
    """Of ten days after the first four each has a failure, three hours shorter than it at most."""
    chance = SimpleNamespace(uniform=lambda *ends: ends[side], choice=lambda among: among[side])
    monkeypatch.setattr(probe_losses, 'random', SimpleNamespace(Random=lambda _: chance))
    found = failures_of(LossTrialParameters(days=14.0, failures=10))
    begins = [BEGIN + (4 + i) * DAY + first for i in range(10)]
    assert [each.begin for each in found] == pytest.approx(begins, abs=1e-3)
    assert [each.end - each.begin for each in found] == pytest.approx([length] * 10, abs=1e-3)
    assert [each.fault for each in found] == list(ProbeFault) * 2
    assert {(each.level, each.probe) for each in found} == {(level, PROBES[side])}


@pytest.mark.parametrize(
    ('side', 'reads'), [(0, (2.0, -4.9, 8.4, 70.0)), (1, (2.0, 4.9, 11.6, 900.0))]
)
def test_what_a_probe_that_fails_reads_by_hand(side, reads):
    """By a chance that is two deviations off the mean, or at an end; without a wire nothing."""
    sign = 2 * side - 1
    chance = SimpleNamespace(gauss=lambda m, s: m + sign * 2 * s, uniform=lambda *ends: ends[side])
    cut, *others = (Failure(0, fault, 0.0, 1.0, 10.0).reads(chance) for fault in ProbeFault)
    assert cut != cut  # noqa: PLR0124 - not a number
    assert others == pytest.approx(reads)
