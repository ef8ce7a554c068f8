"""The example for ros2_control, as far as it runs here: its files, and the messages on both sides.

ros2_control itself is no wheel on PyPI: that its controllers take these files was not tried.
"""

from __future__ import annotations

import ast
from math import nan, pi
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
import yaml

pytest.importorskip('rclpy')

from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.ros.qos import COMMAND, SENSOR

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / 'config' / 'ros2_control'
CONTROLLERS = yaml.safe_load((FOLDER / 'tree_controllers.yaml').read_text('utf-8'))
STEERING = [f'turret_{i}_steering' for i in range(3)]
WHEELS = [f'turret_{i}_wheel' for i in range(3)]


def hardware():
    return ET.parse(FOLDER / 'tree_hardware.urdf').getroot()  # noqa: S314 - our own


def test_each_controller_commands_joints_that_the_hardware_has_by_that_interface():
    manager = CONTROLLERS['controller_manager']['ros__parameters']
    joints = {
        joint.get('name'): [one.get('name') for one in joint.findall('command_interface')]
        for joint in hardware().find('ros2_control').findall('joint')
    }
    assert set(joints) == {j.get('name') for j in hardware().findall('joint')}
    for name, order, interface in (('steering', STEERING, 'position'),
                                   ('wheels', WHEELS, 'velocity')):  # fmt: skip
        given = CONTROLLERS[name]['ros__parameters']
        assert manager[name]['type'] == 'forward_command_controller/ForwardCommandController'
        assert given == {'joints': order, 'interface_name': interface}
        assert all(joints[joint] == [interface] for joint in order)
    assert manager['update_rate'] >= 20  # `rate` of wheel_kinematics


def test_the_turrets_stand_where_the_tree_has_them():
    given = yaml.safe_load((ROOT / 'config' / 'tree.yaml').read_text('utf-8'))['/**']
    told = given['ros__parameters']
    places = [joint.find('origin').get('xyz').split()
              for joint in hardware().findall('joint')
              if joint.get('name') in STEERING]  # fmt: skip
    assert [float(x) for x, _, _ in places] == told['turret_x']
    assert [float(y) for _, y, _ in places] == told['turret_y']


def test_the_launch_file_joins_what_wheel_kinematics_says_and_hears():
    text = (ROOT / 'launch_scripts' / 'launch' / 'ros2_control.launch.py').read_text('utf-8')
    found = {n.targets[0].id: ast.literal_eval(n.value) for n in ast.parse(text).body
             if isinstance(n, ast.Assign)}  # fmt: skip
    assert {*found['CONTROLLERS']} == {*CONTROLLERS['controller_manager']['ros__parameters']} - {
        'update_rate'
    }
    assert dict(found['REMAPPINGS']) == {
        'steering/commands': 'turrets/steering_commands',
        'wheels/commands': 'turrets/wheel_commands',
        'joint_states': 'turrets/state',
    }


def test_the_messages_of_both_sides_fit(tester):
    """States as joint_state_broadcaster tells them: in its own order, efforts of NaN."""
    angles = tester.listen(Float64MultiArray, 'turrets/steering_commands', COMMAND)
    rates = tester.listen(Float64MultiArray, 'turrets/wheel_commands', COMMAND)
    odometry = tester.listen(Odometry, 'odom', SENSOR)
    node = tester.start(WheelKinematics, rate=50.0, stop_after=60.0, max_age=60.0, wheel_radius=0.1)
    states = tester.publisher(JointState, 'turrets/state', COMMAND)
    twists = tester.publisher(TwistStamped, 'cmd_vel')
    names = sorted([*STEERING, *WHEELS], reverse=True)
    drives = dict.fromkeys(names, 0.0)

    def step():
        """Be ideal drives: stand where commanded, and tell it."""
        if angles and rates:
            drives.update(zip(STEERING, angles[-1].data, strict=True))
            drives.update(zip(WHEELS, rates[-1].data, strict=True))
        state = JointState(name=names, effort=[nan] * 6)
        state.header.stamp = node.get_clock().now().to_msg()
        state.position = [drives[n] if n in STEERING else 0.0 for n in names]
        state.velocity = [0.0 if n in STEERING else drives[n] for n in names]
        states.publish(state)
        twist = TwistStamped()
        twist.twist.linear.y = 0.01
        twists.publish(twist)

    tester.graph.repeat(step, lambda: rates and min(rates[-1].data) > 0.099, every=0.02)
    assert list(angles[-1].data) == pytest.approx([pi / 2] * 3, abs=1e-3)  # to the left
    assert list(rates[-1].data) == pytest.approx([0.1] * 3, abs=1e-3)  # 0.01 m/s / 0.1 m
    tester.graph.repeat(step, lambda: odometry[-1].twist.twist.linear.y > 0.0099, every=0.02)
    assert 'joint' not in node.complaint
