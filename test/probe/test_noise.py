"""Noise: told from sap flow by how far readings lie off the line between their neighbours."""

from __future__ import annotations

from math import nan

import numpy as np
import pytest

from agv_motion.probe import Probe, ProbeParameters
from agv_motion.probe.noise import DOUBTFUL, NoiseWatch
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


def of_a_tree(k, step=900.0):
    """Return the reading ``k`` of a tree [K]."""
    hour = k * step % DAY / 3600.0
    flow = max(np.sin(np.pi * (hour - 8.0) / 12.0), 0.0)
    return 20.0 - 1.5 * float(flow) + 0.001 * (k % 7)


def believed(values, step=900.0):
    """Return what a probe says that has known three days of a tree, and then gets these values."""
    probe = Probe(ProbeParameters())
    for k in range(int(3.5 * DAY / step)):
        probe.update(k * step, of_a_tree(k, step))
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


@pytest.mark.parametrize('hour', [1.0, 3.0, 5.5, 9.0, 13.0, 22.0])
@pytest.mark.parametrize('method', ['predawn', 'moving_window', 'double_regression'])
def test_noise_on_the_level_of_the_tree_leaves_nothing_behind(hour, method):
    """The same has been learnt a day later as by who never saw what was taken back."""
    rng, begin = np.random.default_rng(3), round((4.0 + hour / 24.0) * 96)
    values = [of_a_tree(k) for k in range(6 * 96)]
    values[begin : begin + 14] = rng.normal(20.5, 0.6, 14)
    told, twin = (Probe(ProbeParameters(zero_flow_method=method)) for _ in range(2))
    found = [told.update(900.0 * k, value).quality for k, value in enumerate(values)]
    noise = [k for k, quality in enumerate(found) if quality is Quality.NOISE]
    assert begin < noise[0] < begin + 14 <= noise[-1]
    for k, value in enumerate(values):
        doubtful = noise[0] - DOUBTFUL < k <= noise[-1]
        twin.update(900.0 * k, nan if doubtful else value)
    ours, theirs = told.state(), twin.state()
    assert ours['normaliser'] == theirs['normaliser']
    assert ours['course'] == theirs['course']
    nights, others = (dict(each['zero_flow']['nights']) for each in (ours, theirs))
    assert nights == pytest.approx(others, abs=0.01)
