"""Whether the last hours were such that no sap can have flowed."""

from __future__ import annotations

from math import inf, nan

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.probe.environment import Environment, EnvironmentParameters, QuietAir

DAWN = 1_370_822_400.0


def air_of(rows, step=900.0, **parameters):
    quiet = QuietAir(EnvironmentParameters(**parameters))
    for i, (value, *air) in enumerate(rows):
        quiet.add(DAWN + i * step, value, Environment(*air))
    return quiet


STILL = [(20.0, 0.0, 0.05)] * 8


@pytest.mark.parametrize(
    ('rows', 'quiet'),
    [
        (STILL, True),
        (STILL[:6], False),  # an hour and a quarter is less than three quarters of two hours
        (STILL[:7], True),
        ([(20.0, 30.0, 0.1)] * 8, True),  # on both thresholds
        ([(20.0, 30.1, 0.1)] * 8, False),
        ([(20.0, 30.0, 0.11)] * 8, False),
        ([(20.0, 500.0, 0.05)] * 8 + STILL, True),  # it is more than two hours ago
        ([(20.0, nan, 0.05)] * 7 + STILL[:1], True),  # what is told counts
        ([(20.0, nan, 0.05)] * 8, False),
        ([(20.0, 0.0, inf)] * 8, False),
        ([(20.0, 0.0, 0.05), (20.19, 0.0, 0.05)] * 4, False),
        ([(20.0, 0.0, 0.05), (20.185, 0.0, 0.05)] * 4, True),
    ],
)
def test_each_rule(rows, quiet):
    """Of two values in turn, n = 8: 0.19 apart the variation is 0.505 %, 0.185 apart 0.492 %."""
    assert air_of(rows).is_quiet() is quiet


def test_a_clock_set_back_forgets():
    quiet = air_of([(20.0, 500.0, 0.05)] * 8)
    for k in range(7):
        assert not quiet.is_quiet()
        quiet.add(DAWN + 100.0 + 900.0 * k, 20.0, Environment(0.0, 0.0))
    assert quiet.is_quiet()


def test_three_readings_are_enough_and_two_are_not():
    assert air_of(STILL[:3], step=2700.0).is_quiet()
    assert not air_of(STILL[:2], step=5400.0).is_quiet()


@pytest.mark.parametrize('change', [{'hours': 0.0}, {'radiation_below': nan}, {'days': 0}])
def test_limits_that_make_no_sense_are_refused(change):
    with pytest.raises(ConfigurationError, match=next(iter(change))):
        EnvironmentParameters(**change)
