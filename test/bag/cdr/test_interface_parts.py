"""What the topics of services and actions carry, from the one file that defines them."""

from __future__ import annotations

import pytest

from agv_motion.bag.cdr.interface_parts import base, following, sections


@pytest.mark.parametrize(
    ('name', 'service'),
    [
        ('std_srvs/SetBool_Request', 'std_srvs/SetBool'),
        ('std_srvs/SetBool_Event', 'std_srvs/SetBool'),
        ('nav2_msgs/Spin_FeedbackMessage', 'nav2_msgs/Spin'),
        ('nav2_msgs/Spin_SendGoal_Request', 'nav2_msgs/Spin'),
        ('nav2_msgs/Spin_Goal', 'nav2_msgs/Spin'),
        ('std_msgs/String', 'std_msgs/String'),
    ],
)
def test_the_service_or_action_to_which_a_message_belongs(name, service):
    assert base(name) == service


def test_sections_take_the_names_of_their_places():
    lines = ['bool data', '---', 'bool success', 'string message']
    assert list(sections('std_srvs/SetBool_Event', lines)) == [
        ('std_srvs/SetBool_Request', ['bool data']),
        ('std_srvs/SetBool_Response', ['bool success', 'string message']),
    ]
    action = dict(sections('nav2_msgs/Spin', ['float32 yaw', ' --- ', '---', 'float32 turned']))
    assert action == {
        'nav2_msgs/Spin_Goal': ['float32 yaw'],
        'nav2_msgs/Spin_Result': [],
        'nav2_msgs/Spin_Feedback': ['float32 turned'],
    }
    assert list(sections('a/B', ['int8 x'])) == [('a/B', ['int8 x'])]


def test_what_follows_from_a_name_alone():
    event = following('std_srvs/SetBool_Event').splitlines()
    assert event[1] == 'std_srvs/SetBool_Request[<=1] request'
    feedback = following('nav2_msgs/Spin_FeedbackMessage')
    assert feedback.endswith('goal_id\nnav2_msgs/Spin_Feedback feedback')
    assert following('builtin_interfaces/Time') == 'int32 sec\nuint32 nanosec'
    assert following('std_msgs/String') == ''
