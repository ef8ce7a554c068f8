"""Who may look may not act, and nobody gets past the arbiter."""

from __future__ import annotations

import pytest

from agv_motion.dashboard.foxglove.permissions import Permissions
from agv_motion.dashboard.foxglove.protocol import Capability

LOOKS, OPERATES, CHANGES = (
    Permissions(),
    Permissions(acts=True),
    Permissions(acts=True, changes=True),
)
TWIST = 'geometry_msgs/msg/TwistStamped'


def test_who_only_looks_is_offered_nothing_that_acts():
    offered = set(LOOKS.capabilities(simulated=True))
    assert not offered & {Capability.PUBLISH, Capability.SERVICES}
    assert Capability.TIME in offered
    assert Capability.TIME not in LOOKS.capabilities(simulated=False)
    assert 'only shows' in LOOKS.refuses_topic('/oak/cmd_vel/manual', TWIST)
    assert not LOOKS.sees_service('/oak/arbiter/stop')
    assert {Capability.PUBLISH, Capability.SERVICES} <= set(OPERATES.capabilities(simulated=False))


@pytest.mark.parametrize(
    'topic',
    ['/cmd_vel', '/oak/cmd_vel', '/oak/cmd_vel/agent', '/oak/cmd_vel/route', '/oak/cmd_vel/page',
     '/oak/cmd_vel/sequence', '/oak/cmd_vel/limited', '/oak/turrets/command', '/wheels/command',
     '/clock', '/tf', '/oak/odom', 'cmd_vel/manual', '/xcmd_vel/manual', '/zone',
     '/parameter_events', '/oak/cmd_vel/manual/', '/oak/standstill'],
)  # fmt: skip
def test_nobody_speaks_past_the_arbiter(topic):
    for who in (OPERATES, CHANGES):
        assert 'cannot be published' in who.refuses_topic(topic, TWIST), who


def test_who_operates_says_what_persons_say_in_the_type_for_it():
    assert OPERATES.refuses_topic('/oak/cmd_vel/manual', TWIST) == ''
    assert OPERATES.refuses_topic('/cmd_vel/stop', TWIST) == ''
    assert OPERATES.refuses_topic('/goal_pose', 'geometry_msgs/msg/PoseStamped') == ''
    assert 'is of geometry_msgs/msg/PoseStamped' in OPERATES.refuses_topic('/goal_pose', TWIST)


def test_services_of_operators_and_of_experts():
    for name in ('/oak/arbiter/stop', '/motion_generator/go_home'):
        assert OPERATES.sees_service(name)
        assert CHANGES.sees_service(name)
    assert not OPERATES.sees_service('/oak/granier_probe/recalibrate')
    assert not OPERATES.sees_service('/oak/wheel_kinematics/stop')
    assert CHANGES.sees_service('/oak/granier_probe/recalibrate')
    for name in ('set_parameters', 'set_parameters_atomically', 'change_state'):
        assert not CHANGES.sees_service(f'/oak/arbiter/{name}')
