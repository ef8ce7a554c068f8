"""Noise: told from sap flow by how far readings lie off the line between their neighbours."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.probe import Probe, ProbeParameters
from agv_motion.probe.noise import NoiseWatch
from agv_motion.probe.quality import Quality

DAY = 86400.0


def test_four_of_five_off_their_line_are_noise():
    """Ten in turn with eleven lies 1 off 10.5: 10 % and 9 %."""
    watch = NoiseWatch(0.015)
    told = [watch.add(float(k), 10.0 + k % 2) for k in range(7)]
    assert told == [False] * 5 + [True] * 2
    assert watch.since == 0.0
    assert [watch.add(7.0 + k, 10.0) for k in range(7)] == [True, True, *[False] * 5]
    assert watch.is_quiet()
    assert not watch.add(14.0, 11.0)  # 10 lies half off the line from 10 to 11
    assert not watch.is_quiet()


@pytest.mark.parametrize('step', [0.0, 0.1, -0.1, 1.0])
def test_a_ramp_however_steep_is_none(step):
    watch = NoiseWatch(0.015)
    assert not any(watch.add(float(k), 20.0 + k * step) for k in range(15))


def test_a_step_or_a_spike_is_none():
    watch = NoiseWatch(0.015)
    values = [20.0] * 8 + [23.0] + [20.0] * 8 + [17.0] * 8
    assert not any(watch.add(float(k), value) for k, value in enumerate(values))


def believed(values, step=900.0):
    """Return what a probe says that has known three days of a tree, and then gets these values."""
    probe = Probe(ProbeParameters())
    for k in range(int(3.5 * DAY / step)):
        hour = k * step % DAY / 3600.0
        flow = max(np.sin(np.pi * (hour - 8.0) / 12.0), 0.0)
        probe.update(k * step, 20.0 - 1.5 * float(flow) + 0.001 * (k % 7))
    return [probe.update(3.5 * DAY + k * step, float(v)) for k, v in enumerate(values)]


@pytest.mark.parametrize('seed', range(5))
@pytest.mark.parametrize(('level', 'sigma'), [(20.0, 0.8), (12.0, 1.0), (8.0, 2.0), (6.0, 1.5)])
def test_a_wire_that_hangs_free_is_off_after_a_few_readings(seed, level, sigma):
    told = believed(np.random.default_rng(seed).normal(level, sigma, 200))
    assert all(reading.sap_flow is None for reading in told[12:])
    assert {reading.quality for reading in told[12:]} & {Quality.NOISE, Quality.OFF, Quality.SPIKE}
    if level < 15.0:
        assert all(reading.sap_flow is None for reading in told)


def test_what_was_off_must_stand_still_before_it_is_on_again():
    told = believed([0.1] * 3 + [19.0] * 9)
    assert [reading.quality for reading in told] == [Quality.OFF] * 9 + [Quality.GOOD] * 3


def test_a_level_that_steps_away_tells_no_flow_and_counts_again_when_it_is_back():
    told = believed([10.0] * 8 + [18.5] * 8)
    assert all(reading.sap_flow is None for reading in told[:10])
    back = told[-1]
    assert back.zero_flow == pytest.approx(20.0, abs=0.01)
    assert back.sap_flow is not None
