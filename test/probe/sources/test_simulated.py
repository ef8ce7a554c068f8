"""The simulated tree: a function of time, plausible, and deaf to how it is asked."""

from __future__ import annotations

from math import inf, nan

import numpy as np
import pytest

from agv_motion.errors import SignalError
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


@pytest.mark.parametrize(
    ('day', 'values', 'radiation', 'deficit'),
    [
        (0, (17.941786701632847, 18.096692019309028), 846.5270010552764, 1.157106146533812),
        (1, (18.549460069230626, 18.270079961900393), 529.6684603803413, 1.1569144105282911),
    ],
)
def test_a_seed_says_the_same_in_every_version(day, values, radiation, deficit):
    """What was found out with a seed stays true: a fair noon, and a dull one."""
    source = SimulatedSource(SimulatedSourceParameters(probes=2), 1.0)
    found = source.sample(JUNE + day * DAY + 43900.0, 1.0)
    assert found.values == pytest.approx(values, abs=1e-9)
    assert found.environment == pytest.approx((radiation, deficit), abs=1e-9)


def test_history_is_of_whole_quarters_of_an_hour_and_ends_before_the_present_one():
    source = SimulatedSource(SimulatedSourceParameters(), 1.0 / 24.0)
    for late in (0.0, 100.0, 899.0):
        first = -3600.0 if late == 0.0 else -2700.0
        times = [sample.time - JUNE for sample in source.history(JUNE + late)]
        assert times == [*np.arange(first, -1.0, 900.0)]
        for sample in source.history(JUNE + late):
            assert sample == source.sample(sample.time, 1.0)


def test_readings_come_at_their_period():
    source = SimulatedSource(SimulatedSourceParameters(period=25.0), 1.0)
    assert [s.time for s in source.read(JUNE)] == [JUNE]
    assert [s.time for s in source.read(JUNE + 60.0)] == [JUNE + 25.0, JUNE + 50.0]
    assert source.read(JUNE + 61.0) == []
    assert source.complaint() == ''


def test_a_clock_that_leaps_brings_no_flood_and_no_silence():
    """Forwards: the last 1001 readings; backwards: the present one, as at the start."""
    source = SimulatedSource(SimulatedSourceParameters(period=10.0, probes=1), 1.0)

    def times(after):
        return [sample.time - JUNE for sample in source.read(JUNE + after)]

    assert times(0.0) == [0.0]
    assert times(20_000.0) == [10.0 * k for k in range(1000, 2001)]
    assert times(20_000.0) == []
    assert times(19_990.0) == [19_990.0]
    assert times(19_999.0) == []
    assert times(20_000.0) == [20_000.0]


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


def test_light_that_is_no_number_is_refused_and_forgotten():
    """The flow follows the light by a mean over time: one NaN in it would stay for ever."""
    source = SimulatedSource(SimulatedSourceParameters(period=900.0), 1.0)
    for light in (nan, inf):
        with pytest.raises(SignalError, match='light as a share'):
            source.set_light(light)
    noon = JUNE + DAY / 2
    (found,) = source.read(noon)
    assert found.values == source.sample(noon, 1.0).values


@pytest.mark.parametrize(('light', 'told'), [(-1.0, 0.0), (0.3, 0.3), (2.0, 1.0)])
def test_the_flow_follows_the_light_in_a_quarter_of_an_hour(light, told):
    """By `1 - 1/e` of the way in 900 s."""
    source = SimulatedSource(SimulatedSourceParameters(period=900.0), 1.0)
    source.set_light(light)
    noon = JUNE + DAY / 2
    followed = 1.0 + (told - 1.0) * (1.0 - np.exp(-1.0))
    (found,) = source.read(noon)
    assert found.values == pytest.approx(source.sample(noon, followed).values)


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
    four = sum(uniform(seed, 7) for seed in (1, 102, 203, 304))
    assert gauss(1, 7) == pytest.approx((four - 2.0) * np.sqrt(3.0))


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
