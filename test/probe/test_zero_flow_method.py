"""What nights make of zero flow: by hand, and what each method must do with nights and air."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.probe.environment import Environment, EnvironmentParameters
from agv_motion.probe.zero_flow import ZeroFlow
from agv_motion.probe.zero_flow_method import (
    DoubleRegression,
    MovingWindow,
    Predawn,
    ZeroFlowMethodName,
    method_of,
)

HOUR, DAY = 3600.0, 86400.0
NIGHTS = [20.0, 21.0, 19.0, 20.4, 19.6]
"""of mean 20.0, so that 20.0, 21.0 and 20.4 are not below it: their mean is 20.4666..."""


@pytest.mark.parametrize(
    ('method', 'level'),
    [(Predawn, 19.6), (MovingWindow, 21.0), (DoubleRegression, (20.0 + 21.0 + 20.4) / 3.0)],
)
def test_five_nights_by_hand(method, level):
    assert method(7).level(NIGHTS) == pytest.approx(level, rel=1e-15)


@given(st.lists(st.floats(5.0, 60.0), min_size=1, max_size=30))
def test_each_lies_between_the_mean_and_the_highest(nights):
    highest, mean = max(nights), sum(nights) / len(nights)
    assert MovingWindow(7).level(nights) == highest
    assert mean - 1e-9 <= DoubleRegression(7).level(nights) <= highest + 1e-9
    assert DoubleRegression(7).level(nights[:1]) == nights[0] == Predawn(7).level(nights[:1])


def fed(method, nights, hour=8.0):
    """Return zero flow after nights, each (level, air), four readings an hour from midnight on."""
    zero_flow = ZeroFlow(2.0, 7.0, method, 0.0)
    for day, (level, air) in enumerate(nights):
        for quarter in range(4 * 7):
            sag = 0.05 * abs(quarter / 4.0 - 5.0)  # highest at five
            zero_flow.update(day * DAY + quarter * 900.0, level - sag, air)
        zero_flow.update(day * DAY + hour * HOUR, level - 2.0, air)
    return zero_flow.value


DARK_AND_MOIST, LIGHT, DRY = Environment(0.0, 0.05), Environment(60.0, 0.05), Environment(0.0, 0.4)
UNTOLD = Environment()


@pytest.mark.parametrize(
    ('second', 'level'),
    [(DARK_AND_MOIST, 19.0), (LIGHT, 20.0), (DRY, 20.0), (UNTOLD, 20.0)],
)
def test_only_a_dark_and_moist_night_tells(second, level):
    """The highest is the median about five o'clock: the reading beside it, a quarter off."""
    method = method_of('environment', 3, EnvironmentParameters())
    value = fed(method, [(20.0, DARK_AND_MOIST), (19.0, second)])
    assert value == pytest.approx(level - 0.05 / 4.0, abs=1e-12)


@pytest.mark.parametrize(
    ('parameters', 'air'), [({'vpd_below': 0.0}, DRY), ({'radiation_below': 0.0}, LIGHT)]
)
def test_what_is_not_asked_does_not_matter(parameters, air):
    method = method_of('environment', 3, EnvironmentParameters(**parameters))
    assert fed(method, [(20.0, air)]) is not None


def test_a_reading_that_wanders_tells_nothing():
    """A sag of 0.05 K an hour is a variation of 0.15 %; half of that is not borne here."""
    strict = EnvironmentParameters(variation_below=0.07)
    assert fed(method_of('environment', 3, strict), [(20.0, DARK_AND_MOIST)]) is None


@pytest.mark.parametrize('hour', [0.0, 12.0])
def test_a_quiet_night_tells_for_its_days(hour):
    """Of thirty days, or four here, whatever zero_flow_days says."""
    given = EnvironmentParameters(days=4)
    nights = [(20.0, DARK_AND_MOIST), *[(19.0, DRY)] * 4]
    assert fed(method_of('environment', 1, given), nights) is not None
    assert fed(method_of('environment', 1, given), [*nights, (19.0, DRY)]) is None


@pytest.mark.parametrize('name', [each.value for each in ZeroFlowMethodName])
def test_nothing_looks_ahead(name):
    """Zero flow of a day is the same whatever comes after, and does not change by day."""
    method = lambda: method_of(name, 3, EnvironmentParameters())  # noqa: E731 - one for each
    nights = [(20.0, DARK_AND_MOIST), (21.0, DARK_AND_MOIST)]
    assert fed(method(), nights) == fed(method(), nights, hour=23.0)
    zero_flow = ZeroFlow(2.0, 7.0, method(), 0.0)
    for quarter in range(28):
        zero_flow.update(quarter * 900.0, 20.0, DARK_AND_MOIST)
        assert zero_flow.value is None
    seen = {zero_flow.update(q * 900.0, 20.0 + 0.1 * q, DARK_AND_MOIST) for q in range(28, 96)}
    assert seen == {20.0}
