"""The simulated tree: a function of time, plausible, and deaf to how it is asked."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.probe.parameters import ProbeParameters
from agv_motion.probe.probe import Probe
from agv_motion.probe.sources.simulated import (
    SimulatedSource,
    SimulatedSourceParameters,
    gauss,
    smooth_noise,
    uniform,
)
from agv_motion.sun import sun

DAY = 86400.0
JUNE = 16600 * DAY


def test_chance_is_splitmix64_as_it_was_published():
    """The first numbers of its state 1234567; a seed and a place in its row are one state."""
    seed = (1234567 - 0x632BE59BD9B4E019) * pow(0xD1B54A32D192ED03, -1, 2**64) % 2**64
    published = 6457827717110365317, 3203168211198807973, 9817491932198370423
    assert [uniform(seed, i) for i in (1, 2, 3)] == [number / 2.0**64 for number in published]


def test_the_same_seed_says_the_same_whatever_was_asked_before():
    one, other = (SimulatedSource(SimulatedSourceParameters(), 1.0) for _ in range(2))
    list(other.history(JUNE))
    other.read(JUNE)
    assert one.sample(JUNE + 5e4, 1.0) == other.sample(JUNE + 5e4, 1.0)
    another = SimulatedSource(SimulatedSourceParameters(seed=2), 1.0)
    assert another.sample(JUNE + 5e4, 1.0) != one.sample(JUNE + 5e4, 1.0)


def test_readings_come_at_their_period():
    source = SimulatedSource(SimulatedSourceParameters(period=25.0), 1.0)
    assert [s.time for s in source.read(JUNE)] == [JUNE]
    assert [s.time for s in source.read(JUNE + 60.0)] == [JUNE + 25.0, JUNE + 50.0]
    assert source.read(JUNE + 61.0) == []


def test_it_looks_like_the_spruce():
    """Zero flow 19 to 21 K, daily range about 1.5 K; nights without flow."""
    source = SimulatedSource(SimulatedSourceParameters(noise=0.0, drift=0.0), 10.0)
    values = np.array([s.values[0] for s in source.history(JUNE)]).reshape(-1, 96)
    assert values.max(axis=1) == pytest.approx(20.0, abs=1e-9)
    depth = 20.0 - values.min(axis=1)
    assert 0.5 < np.median(depth) < 2.5


def test_shade_makes_the_sap_slow_after_some_minutes():
    sunny, shady = (SimulatedSource(SimulatedSourceParameters(noise=0.0), 1.0) for _ in range(2))
    noon = JUNE + DAY / 2
    shady.set_light(0.3)
    first = [source.read(noon)[0].values[0] for source in (sunny, shady)]
    assert abs(first[0] - first[1]) < 0.1
    later = [source.read(noon + 3600.0)[-1].values[0] for source in (sunny, shady)]
    assert later[1] > later[0] + 0.3


def test_a_probe_that_has_learnt_from_its_history_knows_at_once():
    source = SimulatedSource(SimulatedSourceParameters(), 8.0)
    probe = Probe(ProbeParameters())
    noon = JUNE + 12.5 * 3600.0
    probe.warm_up((s.time, s.values[0]) for s in source.history(noon))
    assert probe.update(noon, source.read(noon)[0].values[0]).sap_flow > 0.2


def test_the_noise_is_normal_enough():
    numbers = np.array([gauss(1, k) for k in range(20_000)])
    assert numbers.mean() == pytest.approx(0.0, abs=0.03)
    assert numbers.std() == pytest.approx(1.0, abs=0.03)


def test_smooth_noise_goes_from_one_number_to_the_next_without_a_corner():
    """Half way the mean of both; level at each, where a cosine begins and ends."""
    for whole in range(5):
        a, b = uniform(7, whole), uniform(7, whole + 1)
        assert smooth_noise(7, whole) == a
        assert smooth_noise(7, whole + 0.5) == pytest.approx((a + b) / 2)
        assert smooth_noise(7, whole + 1 / 3) == pytest.approx(a + (b - a) / 4)
        assert smooth_noise(7, whole + 1e-4) == pytest.approx(a, abs=1e-7)
        assert smooth_noise(7, whole + 1 - 1e-4) == pytest.approx(b, abs=1e-7)


def test_the_sun_rises_by_its_own_time():
    """An hour more of it, and the sap flows an hour earlier; before, the tree tells zero flow."""

    def rise(offset):
        given = SimulatedSourceParameters(noise=0.0, drift=0.0, probes=1, solar_offset=offset)
        source = SimulatedSource(given, 1.0)
        minutes = (JUNE + 60.0 * minute for minute in range(1440))
        dark = [source.sample(time, 1.0).values[0] == given.zero_flow for time in minutes]
        return next(k for k in range(1, 1440) if dark[k - 1] and not dark[k])

    assert rise(0.0) - rise(1.0) == pytest.approx(60.0, abs=1.0)


@pytest.mark.parametrize('day', [16476, 16600, 16663, 16742])
def test_the_sap_rises_two_hours_after_the_sun_that_throws_the_shadows(day):
    """Also in February and November, when the sun is a quarter of an hour late, or early."""
    given = SimulatedSourceParameters(noise=0.0, drift=0.0, probes=1)
    source = SimulatedSource(given, 1.0)
    minutes = [day * DAY + 60.0 * minute for minute in range(1440)]
    up = [sun(time, given.latitude, 15.0 * given.solar_offset).elevation > 0.0 for time in minutes]
    flows = [source.sample(time, 1.0).values[0] < given.zero_flow for time in minutes]

    def rise(found):
        return next(k for k in range(1, 1440) if found[k] and not found[k - 1])

    assert rise(flows) - rise(up) == pytest.approx(120.0, abs=1.0)


def test_the_air_is_dark_and_moist_before_dawn_and_bright_at_noon():
    source = SimulatedSource(SimulatedSourceParameters(), 1.0)
    day = 1_434_326_400.0  # 15 June 2015
    night, noon = (source.sample(day + hour * 3600.0, 1.0).environment for hour in (2.5, 12.0))
    assert night.radiation == 0.0
    assert night.vapour_pressure_deficit < 0.1
    assert noon.radiation > 100.0
    assert noon.vapour_pressure_deficit > 0.8
    assert source.sample(day + 43200.0, 0.5).environment.radiation == noon.radiation / 2.0
