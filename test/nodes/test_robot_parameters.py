"""What a person asks of a parameter, as the value of its type, or a refusal in words."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')


@pytest.mark.parametrize('value', [10**400, -(10**400), float('inf'), True, '1'])
def test_what_no_float_can_hold_is_refused_in_words(value):
    from rcl_interfaces.msg import ParameterType

    from agv_motion.dashboard.server.fleet import RefusedError
    from agv_motion.nodes.robot_parameters import _value

    with pytest.raises(RefusedError, match=r'rate = .*expected a finite number'):
        _value('rate', value, ParameterType.PARAMETER_DOUBLE)


def test_a_whole_number_is_the_float_of_the_same_worth():
    from rcl_interfaces.msg import ParameterType

    from agv_motion.nodes.robot_parameters import _value

    made = _value('rate', 7, ParameterType.PARAMETER_DOUBLE)
    assert (made.type, made.double_value) == (ParameterType.PARAMETER_DOUBLE, 7.0)
