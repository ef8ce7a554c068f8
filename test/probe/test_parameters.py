"""Parameters of a probe that contradict each other are refused by name."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.probe.environment import EnvironmentParameters
from agv_motion.probe.parameters import ProbeParameters


@pytest.mark.parametrize(
    ('low', 'high', 'value'),
    [
        ('low_quantile', 'high_quantile', 0.5),
        ('night_start', 'night_end', 3.0),
        ('off_below', 'highest', 5.0),
    ],
)
def test_of_a_pair_the_first_is_below_the_second(low, high, value):
    assert getattr(ProbeParameters(**{low: value - 0.1, high: value}), low) == value - 0.1
    for first in (value, value + 0.1):
        match = f'^{low} = {first} is not below {high} = {value}: exchange or correct them$'
        with pytest.raises(ConfigurationError, match=match):
            ProbeParameters(**{low: first, high: value})


@pytest.mark.parametrize(
    ('radiation', 'vpd', 'asks'),
    [(30.0, 0.1, True), (30.0, 0.0, True), (0.0, 0.1, True), (0.0, 0.0, False)],
)
def test_zero_flow_by_the_air_asks_something_of_it(radiation, vpd, asks):
    air = EnvironmentParameters(radiation_below=radiation, vpd_below=vpd)
    assert not ProbeParameters(environment=air).needs_environment
    if asks:
        given = ProbeParameters(environment=air, zero_flow_method='environment')
        assert given.needs_environment
        return
    with pytest.raises(ConfigurationError, match='asks nothing: give environment'):
        ProbeParameters(environment=air, zero_flow_method='environment')
