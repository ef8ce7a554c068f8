"""Which parameters a node has on a recording, from a file as ROS takes it."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from agv_motion.errors import ConfigurationError
from agv_motion.reprocess.recorded import parameters

FILE = """
oak:
  wheel_kinematics: {ros__parameters: {wheel_radius: 0.21}}
/elm/wheel_kinematics: {ros__parameters: {wheel_radius: 0.22}}
/oak/**: {ros__parameters: {rate: 7.0, laps: 3}}
"""


def test_parameters_are_those_that_the_live_node_would_take(tmp_path):
    path = tmp_path / 'two.yaml'
    path.write_text(FILE)
    given = parameters(str(path), 'wheel_kinematics', '/oak')
    assert given['wheel_radius'] == 0.21
    assert 'laps' not in given
    assert parameters(str(path), 'wheel_kinematics', '/elm') == {'wheel_radius': 0.22}
    assert parameters(str(path), 'route_follower', '/oak')['laps'] == 3
    assert parameters(str(path), 'route_follower', '/') == {}
    with pytest.raises(ConfigurationError, match='it is for /elm or /oak; give it by --namespace'):
        parameters(str(path), 'wheel_kinematics')
    path.write_text(FILE + '"/**": {ros__parameters: {wheel_radius: 0.3}}\n')
    assert parameters(str(path), 'wheel_kinematics', '/oak')['wheel_radius'] == 0.3  # as rcl does


def test_what_the_robot_has_learnt_stays_untouched(tmp_path):
    path = tmp_path / 'one.yaml'
    path.write_text('/**: {ros__parameters: {memory_file: /m, state_file: /s}}\n')
    assert parameters(str(path), 'motion_generator')['memory_file'] == ''
    assert parameters(str(path), 'granier_probe')['state_file'] == ''
