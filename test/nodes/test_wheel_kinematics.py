"""Node `wheel_kinematics` over a real graph: commands, refusals, silence and the last word."""

from __future__ import annotations

import time
from itertools import count, pairwise
from math import cos, inf, nan, pi, sin

import pytest

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.exceptions import InvalidParameterValueException
from rclpy.lifecycle import TransitionCallbackReturn
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray, String
from std_srvs.srv import SetBool, Trigger

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.kinematics.turrets import Turrets
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.planar import Twist as Twist2D
from agv_motion.ros.messages import TurretJoints, seconds_of
from agv_motion.ros.qos import LATCHED, SENSOR
from agv_motion.ros.run import StartError

PAIR = {'turret_x': [0.5, -0.5], 'turret_y': [0.0, 0.0]}
QUICK = {
    **PAIR, 'steering_rate': 100.0, 'steering_acceleration': 1e4, 'wheel_acceleration': 100.0,
}  # fmt: skip
FAST = {**QUICK, 'max_wheel_speed': 5.0, 'max_age': 1e10}


def twist(vx=0.0, vy=0.0, wz=0.0):
    message = TwistStamped()
    message.twist.linear.x, message.twist.linear.y, message.twist.angular.z = vx, vy, wz
    return message


def rates(command):
    return [v for name, v in zip(command.name, command.velocity, strict=True) if 'wheel' in name]


def angles(command):
    return list(command.position[: len(command.name) // 2])  # none where turrets are left alone


@pytest.fixture
def drive(tester):
    """Return the inbox of commands and a publisher of twists for a node with parameters."""

    def run(**parameters):
        commands = tester.listen(JointState, 'turrets/command')
        node = tester.start(WheelKinematics, **parameters)
        return node, commands, tester.publisher(TwistStamped, 'cmd_vel')

    return run


def test_a_twist_becomes_angle_and_rate_of_each_turret(tester, drive):
    """Hand calculation: turning at 1 rad/s, arms of 0.5 m, wheels of 0.1 m: 5 rad/s."""
    _, commands, cmd_vel = drive(**FAST)
    command = tester.wait(
        commands, lambda m: any(m.velocity), saying=lambda: cmd_vel.publish(twist(wz=1.0))
    )
    assert abs(seconds_of(command.header.stamp) - time.time()) < 10.0
    assert command.header.frame_id == 'base_link'
    assert list(command.name) == [
        'turret_0_steering', 'turret_1_steering', 'turret_0_wheel', 'turret_1_wheel',
    ]  # fmt: skip
    assert angles(command) == pytest.approx([pi / 2, -pi / 2])
    assert rates(command) == pytest.approx([5.0, 5.0])


def test_the_plain_arrays_for_ros2_control_say_the_same(tester, drive):
    steering = tester.listen(Float64MultiArray, 'turrets/steering_commands')
    wheels = tester.listen(Float64MultiArray, 'turrets/wheel_commands')
    _, _, cmd_vel = drive(**FAST)
    tester.graph.spin_for(0.4)  # the node looks for listeners ten times a second
    cmd_vel.publish(twist(vy=1.0))
    assert list(tester.wait(steering, lambda m: m.data[0] != 0.0).data) == [pi / 2] * 2
    assert list(tester.wait(wheels, lambda m: m.data[0] != 0.0).data) == [10.0] * 2


def test_too_fast_a_twist_is_scaled_as_a_whole(tester, drive):
    _, commands, cmd_vel = drive(**QUICK)
    command = tester.wait(
        commands, lambda m: any(m.velocity), saying=lambda: cmd_vel.publish(twist(vx=1.0))
    )
    assert rates(command) == pytest.approx([2.0 / 60.0 / 0.1] * 2)


def test_an_unstamped_twist_serves_too(tester):
    commands = tester.listen(JointState, 'turrets/command')
    tester.start(WheelKinematics, stamped=False, **FAST)
    message = Twist()
    message.linear.x = 0.3
    tester.publisher(Twist, 'cmd_vel').publish(message)
    assert rates(tester.wait(commands, lambda m: any(m.velocity))) == pytest.approx([3.0] * 2)


@pytest.mark.parametrize('bad', [nan, inf])
def test_a_twist_that_is_not_finite_is_refused_and_the_node_lives(tester, drive, bad):
    node, commands, cmd_vel = drive(**FAST)
    cmd_vel.publish(twist(vx=bad))
    tester.graph.spin_until(lambda: 'must be finite' in node.complaint)
    assert not any(any(command.velocity) for command in commands)
    assert rates(
        tester.wait(
            commands, lambda m: any(m.velocity), saying=lambda: cmd_vel.publish(twist(vx=0.3))
        )
    ) == pytest.approx([3.0] * 2)


def test_silence_stops_the_wheels_and_holds_the_angles(tester, drive):
    _, commands, cmd_vel = drive(report_after=0.2, stop_after=0.4, **FAST)
    tester.wait(commands, lambda m: any(m.velocity), saying=lambda: cmd_vel.publish(twist(vy=0.3)))
    tester.graph.spin_until(lambda: not any(commands[-1].velocity))
    assert angles(commands[-1]) == [pi / 2] * 2
    commands.clear()
    tester.graph.spin_for(0.3)
    assert not any(any(rates(command)) for command in commands)


def test_the_last_word_of_a_deactivated_node_is_zero(tester, drive):
    node, commands, cmd_vel = drive(**FAST)
    tester.wait(commands, lambda m: any(m.velocity), saying=lambda: cmd_vel.publish(twist(vx=0.3)))
    node.trigger_deactivate()
    tester.graph.spin_until(lambda: rates(commands[-1]) == [0.0, 0.0])
    told = len(commands)
    cmd_vel.publish(twist(vx=0.3))
    tester.graph.spin_for(0.3)
    assert len(commands) == told


def test_the_stop_service_holds_until_released(tester, drive):
    _, commands, cmd_vel = drive(**FAST)
    assert tester.ask(SetBool, 'wheel_kinematics/stop', SetBool.Request(data=True)).success
    commands.clear()
    assert rates(tester.wait(commands, saying=lambda: cmd_vel.publish(twist(vx=0.3)))) == [0.0, 0.0]
    assert tester.ask(SetBool, 'wheel_kinematics/stop', SetBool.Request(data=False)).success
    tester.wait(commands, lambda m: any(m.velocity), saying=lambda: cmd_vel.publish(twist(vx=0.3)))


def state(angle, rate, stamp=0.0):
    message = TurretJoints(2).message()
    message.header.stamp.sec, message.header.stamp.nanosec = 100, int(stamp * 1e9)
    TurretJoints(2).fill(message, angle, rate)
    return message


def test_turrets_that_fight_stop_the_platform(tester, drive):
    """Hand calculation: 0.3 m/s apart in opposite directions leaves 0.3 m/s unexplained."""
    node, commands, cmd_vel = drive(**FAST)
    residual = tester.listen(Float64, 'turrets/residual', SENSOR)
    joint_states = tester.publisher(JointState, 'turrets/state', SENSOR)
    tester.graph.spin_for(0.2)
    joint_states.publish(state([0.0, pi], [3.0, 3.0]))
    assert tester.wait(residual).data == pytest.approx(0.3)
    tester.graph.spin_until(lambda: 'stopped' in node.plain.diagnose().message)
    commands.clear()
    assert rates(tester.wait(commands, saying=lambda: cmd_vel.publish(twist(vx=0.3)))) == [0.0, 0.0]


def test_odometry_follows_the_measured_wheels(tester, drive):
    """Hand calculation: 0.5 m/s along y for 0.8 s."""
    odometry = tester.listen(Odometry, 'odom', SENSOR)
    drive(**FAST)
    joint_states = tester.publisher(JointState, 'turrets/state', SENSOR)
    tester.graph.spin_for(0.2)
    for stamp in (0.1, 0.5, 0.9):
        joint_states.publish(state([pi / 2, pi / 2], [5.0, 5.0], stamp))
        tester.graph.spin_for(0.1)
    last = tester.wait(odometry, lambda m: m.pose.pose.position.y > 0.3)
    assert last.pose.pose.position.y == pytest.approx(0.4)
    # by hand: 0.4 m with 0.02 m after 1 m, over two wheels
    assert last.pose.covariance[7] == pytest.approx(0.02**2 * 0.4 / 2)
    assert last.pose.covariance[35] > 0.0
    assert last.header.frame_id == 'odom'
    assert last.child_frame_id == 'base_link'


@pytest.mark.parametrize(
    ('change', 'word'),
    [
        (lambda m: setattr(m, 'name', [*m.name[:3], 'nose']), 'turret_1_wheel is missing'),
        (lambda m: setattr(m, 'velocity', [1.0]), '1 velocities for 4 joints'),
        (lambda m: setattr(m, 'position', [0.0, nan, 0.0, 0.0]), 'must be finite'),
    ],
)
def test_a_state_that_does_not_fit_is_refused(tester, drive, change, word):
    node, _, _ = drive(**FAST)
    joint_states = tester.publisher(JointState, 'turrets/state', SENSOR)
    message = state([0.0, 0.0], [1.0, 1.0])
    change(message)
    joint_states.publish(message)
    tester.graph.spin_until(lambda: word in node.complaint)


def test_an_impossible_platform_does_not_start(tester):
    with pytest.raises(ConfigurationError, match='1 values in turret_x, 2 in turret_y'):
        tester.start(WheelKinematics, turret_x=[0.5], turret_y=[0.0, 0.0])
    with pytest.raises(StartError, match='configure failed'):
        tester.start(WheelKinematics, turret_x=[0.5], turret_y=[0.0])


@pytest.mark.parametrize('radius', [0.0, -0.1, 20.0, nan])
def test_a_radius_out_of_range_is_refused(tester, radius):
    with pytest.raises((InvalidParameterValueException, ConfigurationError)):
        tester.start(WheelKinematics, wheel_radius=radius)


def test_an_integer_for_a_number_is_refused(tester):
    with pytest.raises(ConfigurationError, match=r'wheel_radius = 1: .*write 1\.0'):
        tester.start(WheelKinematics, wheel_radius=1)


def test_a_dynamic_parameter_is_validated_before_it_changes(tester):
    node = tester.start(WheelKinematics, **PAIR)
    (refused,) = node.set_parameters([rclpy.Parameter('residual_warning', value=0.5)])
    assert not refused.successful
    assert 'warn before stopping' in refused.reason
    assert node.parameters.residual_warning == 0.005
    (taken,) = node.set_parameters([rclpy.Parameter('residual_warning', value=0.01)])
    assert taken.successful
    assert node.parameters.residual_warning == 0.01


def test_parameters_describe_themselves(tester):
    descriptor = tester.start(WheelKinematics, **PAIR).describe_parameter('wheel_radius')
    assert descriptor.description == 'rolling radius of all wheels [m]'
    assert descriptor.read_only
    assert descriptor.floating_point_range[0].from_value == 0.001


def test_cleanup_closes_the_topics_and_the_node_starts_again(tester, drive):
    node, commands, cmd_vel = drive(**FAST)
    node.trigger_deactivate()
    assert node.trigger_cleanup() is TransitionCallbackReturn.SUCCESS
    tester.graph.spin_until(lambda: cmd_vel.get_subscription_count() == 0)
    assert node.trigger_configure() is TransitionCallbackReturn.SUCCESS
    assert node.trigger_activate() is TransitionCallbackReturn.SUCCESS
    tester.graph.spin_until(lambda: cmd_vel.get_subscription_count() == 1)
    tester.wait(commands, lambda m: any(m.velocity), saying=lambda: cmd_vel.publish(twist(vx=0.3)))


def test_from_rest_the_turrets_steer_before_the_wheels_roll(tester, drive):
    _, commands, cmd_vel = drive(**FAST)
    joint_states = tester.publisher(JointState, 'turrets/state', SENSOR)
    tester.graph.spin_for(0.2)
    joint_states.publish(state([0.0, 0.0], [0.0, 0.0], 0.1))
    tester.graph.spin_for(0.2)
    commands.clear()
    command = tester.wait(
        commands, lambda m: any(m.position), saying=lambda: cmd_vel.publish(twist(vy=0.3))
    )
    assert angles(command) == pytest.approx([pi / 2] * 2)
    assert rates(command) == pytest.approx([0.0] * 2, abs=1e-12)
    joint_states.publish(state([pi / 2 - pi / 3, pi / 2], [0.0, 0.0], 0.2))
    tester.graph.spin_for(0.2)
    commands.clear()
    command = tester.wait(
        commands, lambda m: any(m.velocity), saying=lambda: cmd_vel.publish(twist(vy=0.3))
    )
    assert rates(command) == pytest.approx([1.5] * 2)


def test_a_turret_never_goes_the_long_way_round(tester, drive):
    _, commands, cmd_vel = drive(**FAST)
    for heading in (3.0, 3.3):
        cmd_vel.publish(twist(0.3 * cos(heading), 0.3 * sin(heading)))
        wanted = pytest.approx([heading - pi] * 2)  # both wheels reversed
        tester.wait(commands, lambda m: any(rates(m)) and angles(m) == wanted)  # noqa: B023
    assert all(abs(a) < 0.16 for command in commands if command.position for a in angles(command))


def test_on_the_way_to_another_twist_all_axes_meet_and_no_limit_is_exceeded(tester, drive):
    """From driving forward to sideways with a turn: every command on the way has one ICR."""
    slow = {'steering_rate': 1.0, 'steering_acceleration': 10.0, 'wheel_acceleration': 1.0}
    limits = SteeringLimits(max_wheel_speed=0.5, **slow)
    _, commands, cmd_vel = drive(**PAIR, max_wheel_speed=0.5, rate=50.0, **slow)
    tester.wait(
        commands,
        lambda m: rates(m) == pytest.approx([3.0] * 2),
        saying=lambda: cmd_vel.publish(twist(vx=0.3)),
    )
    commands.clear()
    cmd_vel.publish(twist(vx=0.2, vy=0.2, wz=0.3))
    pair = Turrets([(0.5, 0.0), (-0.5, 0.0)])
    wanted = pair.command(Twist2D(0.2, 0.2, 0.3), [0.0] * 2)
    end = pytest.approx([*wanted.angle, *(speed / 0.1 for speed in wanted.speed)])
    tester.wait(commands, lambda m: [*angles(m), *rates(m)] == end)
    for before, after in pairwise(commands):
        speeds = [rate * 0.1 for rate in rates(after)]
        assert pair.twist(angles(after), speeds).residual < 1e-12
        passed = seconds_of(after.header.stamp) - seconds_of(before.header.stamp)
        for old, new in zip(angles(before), angles(after), strict=True):
            assert abs(new - old) <= limits.steering_rate * passed + 1e-6
    assert len(commands) > 20


def test_a_turret_that_was_turned_by_hand_is_taken_from_where_it_stands(tester, drive):
    _, commands, cmd_vel = drive(**FAST)
    joint_states = tester.publisher(JointState, 'turrets/state', SENSOR)
    tester.graph.spin_for(0.2)
    joint_states.publish(state([0.0, 0.0], [0.0, 0.0], 0.1))
    tester.wait(
        commands, lambda m: list(m.position) == [0.0] * 4, saying=lambda: cmd_vel.publish(twist())
    )
    commands.clear()
    joint_states.publish(state([0.0, 1.0], [0.0, 0.0], 0.2))
    tester.wait(commands, lambda m: angles(m) == [0.0, 1.0])


def test_zeros_of_the_steering_are_taken_into_account(tester, drive):
    """A turret that reads 0.1 rad too little is told 0.1 rad less, and believed 0.1 rad more."""
    node, commands, cmd_vel = drive(steering_zero=[0.1, 0.0], **FAST)
    joint_states = tester.publisher(JointState, 'turrets/state', SENSOR)
    tester.graph.spin_for(0.2)
    joint_states.publish(state([-0.1, 0.0], [3.0, 3.0], 0.1))
    command = tester.wait(
        commands, lambda m: any(rates(m)), saying=lambda: cmd_vel.publish(twist(vx=0.3))
    )
    assert angles(command) == pytest.approx([-0.1, 0.0])
    assert node.plain.diagnose().values['residual [m/s]'] == '0.00000'
    with pytest.raises(ConfigurationError, match='steering_zero'):
        tester.start(WheelKinematics, steering_zero=[0.1], **PAIR)


def test_cables_are_unwound_at_rest_and_only_there(tester, drive):
    """A turret a turn and a tenth away goes back by one turn, along the same line."""
    _, commands, cmd_vel = drive(turn_limit=2.0, **FAST)
    joint_states = tester.publisher(JointState, 'turrets/state', SENSOR)
    tester.graph.spin_for(0.2)
    joint_states.publish(state([2.2 * pi, 0.1], [0.0, 0.0], 0.1))
    tester.wait(commands, lambda m: any(rates(m)), saying=lambda: cmd_vel.publish(twist(vx=0.3)))
    refused = tester.ask(Trigger, 'wheel_kinematics/unwind', Trigger.Request())
    assert not refused.success
    assert 'zero cmd_vel' in refused.message
    joint_states.publish(state([2.0 * pi, 0.0], [0.0, 0.0], 0.2))  # they have followed
    tester.graph.repeat(
        lambda: cmd_vel.publish(twist()), until=lambda: not any(rates(commands[-1]))
    )
    answer = tester.ask(Trigger, 'wheel_kinematics/unwind', Trigger.Request())
    assert answer.success
    assert '360 deg' in answer.message
    tester.wait(commands, lambda m: angles(m) == pytest.approx([0.0, 0.0], abs=1e-9))


def test_what_limits_the_motion_is_told(tester, drive):
    limiters = tester.listen(String, 'turrets/limiter', LATCHED)
    node, _, cmd_vel = drive(max_wheel_speed=0.1, **(QUICK | {'steering_rate': 1.0}))
    tester.wait(
        limiters,
        lambda m: m.data == 'turning the turrets before rolling',
        saying=lambda: cmd_vel.publish(twist(vy=0.3)),
    )
    tester.wait(
        limiters, lambda m: m.data == 'wheel speed', saying=lambda: cmd_vel.publish(twist(vy=0.3))
    )
    assert node.plain.diagnose().values['limited by'] == 'wheel speed'
    (taken,) = node.set_parameters([rclpy.Parameter('wheel_acceleration', value=0.01)])
    assert taken.successful
    tester.wait(
        limiters,
        lambda m: m.data == 'wheel acceleration',
        saying=lambda: cmd_vel.publish(twist(vy=0.01)),
    )


def test_turrets_that_fall_silent_stop_the_platform(tester, drive):
    _, commands, cmd_vel = drive(report_after=0.2, stop_after=0.5, **FAST)
    joint_states = tester.publisher(JointState, 'turrets/state', SENSOR)
    tester.graph.spin_for(0.2)
    joint_states.publish(state([0.0, 0.0], [0.0, 0.0], 0.1))
    tester.wait(commands, lambda m: any(m.velocity), saying=lambda: cmd_vel.publish(twist(vx=0.3)))
    tester.graph.repeat(
        lambda: cmd_vel.publish(twist(vx=0.3)), until=lambda: rates(commands[-1]) == [0.0, 0.0]
    )
    stamps = count(2)

    def speak():
        joint_states.publish(state([0.0, 0.0], [0.0, 0.0], 0.1 * next(stamps)))
        cmd_vel.publish(twist(vx=0.3))

    tester.graph.repeat(speak, until=lambda: any(commands[-1].velocity))


def test_before_anything_is_known_the_turrets_are_left_alone(tester, drive):
    """No state yet: zero to the wheels, and nothing that would turn a turret."""
    _, commands, cmd_vel = drive(**FAST)
    tester.wait(commands)
    cmd_vel.publish(twist())
    tester.graph.spin_for(0.2)
    stop = commands[-1]
    assert list(stop.name) == ['turret_0_wheel', 'turret_1_wheel']
    assert list(stop.velocity) == [0.0, 0.0]
    assert not stop.position


def turrets_at(*told):
    """Return a message of turrets that stand at these angles [rad]."""
    joints = TurretJoints(len(told))
    message = joints.message()
    joints.fill(message, told, [0.0] * len(told))
    return message


def test_a_turret_found_beyond_its_limit_turns_back_and_the_node_says_so(drive, tester):
    node, commands, cmd_vel = drive(**FAST)
    state = tester.publisher(JointState, 'turrets/state', SENSOR)
    state.publish(turrets_at(24.0, 0.0))
    tester.graph.spin_until(lambda: 'beyond its turn_limit' in node.plain.diagnose().message)
    for _ in range(300):
        cmd_vel.publish(twist(vx=1.0))
        tester.graph.spin_for(0.02)
        if commands and any(rates(commands[-1])):
            break
        state.publish(turrets_at(*(angles(commands[-1]) if commands else (24.0, 0.0))))
    assert any(rates(commands[-1]))
    assert max(map(abs, angles(commands[-1]))) <= 1.5 * 2 * pi
    assert 'beyond' not in node.plain.diagnose().message


@pytest.mark.parametrize('bad', [1e9, 1.7e308, nan])
def test_an_angle_that_cannot_be_leaves_the_platform_standing(drive, tester, bad):
    node, commands, cmd_vel = drive(**FAST)
    state = tester.publisher(JointState, 'turrets/state', SENSOR)
    state.publish(turrets_at(0.0, bad))
    tester.graph.spin_until(lambda: node.complaint)
    assert 'turret 1 stands at' in node.complaint or 'finite' in node.complaint
    if bad == bad:  # noqa: PLR0124 - not NaN
        cmd_vel.publish(twist(vx=1.0))
        assert not any(rates(tester.wait(commands)))
        assert 'look at the encoder' in node.plain.diagnose().message
    state.publish(turrets_at(0.0, 0.0))
    commands.clear()
    for _ in range(300):
        cmd_vel.publish(twist(vx=1.0))
        tester.graph.spin_for(0.02)
        if commands and any(rates(commands[-1])):
            break
    assert any(rates(commands[-1]))


def test_activated_again_it_stands_until_a_twist_comes(tester, drive):
    node, commands, cmd_vel = drive(**FAST)
    tester.wait(commands, lambda m: any(rates(m)), saying=lambda: cmd_vel.publish(twist(vx=1.0)))
    node.trigger_deactivate()
    tester.graph.spin_until(lambda: not any(rates(commands[-1])))
    commands.clear()
    node.trigger_activate()
    tester.graph.spin_until(lambda: len(commands) > 3)
    assert not any(any(rates(command)) for command in commands)
    tester.wait(commands, lambda m: any(rates(m)), saying=lambda: cmd_vel.publish(twist(vx=1.0)))


def test_what_is_commanded_after_all_limits_is_told(drive, tester):
    limited = tester.listen(TwistStamped, 'cmd_vel/limited')
    _, _, cmd_vel = drive(**QUICK, max_wheel_speed=0.5)
    told = tester.wait(
        limited,
        lambda m: m.twist.linear.x == pytest.approx(0.5),
        saying=lambda: cmd_vel.publish(twist(vx=2.0)),
    )
    assert told.header.frame_id == 'base_link'
    assert told.header.stamp.sec > 0
