"""What lies outside its range is refused with a remedy; no ramp is one without end."""

from __future__ import annotations

from math import inf, nan

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.trajectory.bounds import AT_ONCE, NO_RAMP, require_between, require_ramp


def test_the_ends_of_a_range_belong_to_it():
    assert [require_between('speed', x, (1.0, 2.0), 'm/s') for x in (1.0, 2.0)] == [1.0, 2.0]


@pytest.mark.parametrize('bad', [0.999, 2.001, inf, -inf, nan])
def test_what_lies_outside_is_refused(bad):
    words = rf'speed = {bad} m/s: must lie in \[1, 2\] m/s; walk$'
    with pytest.raises(ConfigurationError, match=words):
        require_between('speed', bad, (1.0, 2.0), 'm/s', 'walk')


def test_no_ramp_is_one_without_end():
    assert require_ramp('braking', NO_RAMP) == AT_ONCE
    assert require_ramp('braking', 0.4) == 0.4


@pytest.mark.parametrize('bad', [-0.1, 1e-12, inf, nan])
def test_a_ramp_that_cannot_be_meant_is_refused(bad):
    with pytest.raises(ConfigurationError, match=r'braking = .*for no ramp give 0'):
        require_ramp('braking', bad)
