"""Limits that cannot be are refused."""

from __future__ import annotations

from math import nan

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.steering.limits import SteeringLimits


@pytest.mark.parametrize(('name', 'value'), [('turn_limit', 0.2), ('steering_rate', nan)])
def test_limits_are_checked(name, value):
    with pytest.raises(ConfigurationError, match=f'{name} = {value}'):
        SteeringLimits(**{name: value})
