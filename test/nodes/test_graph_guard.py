"""Nodes beside others on their topics: rivals, crowds, and ends that never meet."""

from __future__ import annotations

import pytest

rclpy = pytest.importorskip('rclpy')

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped, Twist, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.nodes.differential_simulator import DifferentialSimulator
from agv_motion.nodes.ghost_trajectory import GhostTrajectory
from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.nodes.localization import Localization
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.omni_kinematics import OmniKinematics
from agv_motion.nodes.omni_simulator import OmniSimulator
from agv_motion.nodes.route_follower import RouteFollowerNode
from agv_motion.nodes.sequence import SequenceNode
from agv_motion.nodes.simulator import Simulator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.ros import graph_guard
from agv_motion.ros.diagnosis import ERROR, OK, WARN
from agv_motion.ros.graph_watch import IN_TURN

BEST_EFFORT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
BASE = {'track': 0.4, 'wheel_radii': [0.05, 0.05]}
PATIENT = BASE | {'stop_after': 3000.0, 'report_after': 3000.0}


class Onlooker:
    """Reads log and diagnostics, and has a participant of its own for what does not belong."""

    def __init__(self, tester, other, output):
        self.tester, self.graph, self.other = tester, tester.graph, other
        self.foreigners = []
        self._output, self._log = output, ''
        self.reports = tester.listen(DiagnosticArray, '/diagnostics', 100)

    def foreign(self, name):
        """Return a node of another process, as the graph sees it; it lives until the end."""
        self.foreigners.append(rclpy.create_node(name, context=self.other))
        return self.foreigners[-1]

    def gone(self, node):
        self.foreigners.remove(node)
        node.destroy_node()

    def told(self, *words):
        """Wait for a line of the log with all words, and return it."""

        def lines():
            self._log += self._output.readouterr().err
            return [line for line in self._log.splitlines() if all(w in line for w in words)]

        self.graph.spin_until(lambda: bool(lines()))
        return lines()[0]

    def reported(self, node, level, *words):
        """Wait until the diagnostics of a node are as bad, with all words."""
        self.reports.clear()

        def fits(message):
            status = message.status[0]
            text = ' '.join([status.message, *(pair.value for pair in status.values)])
            ours = status.name == node.get_fully_qualified_name()
            return ours and status.level == level and all(word in text for word in words)

        return self.tester.wait(self.reports, fits).status[0]

    def until(self, condition):
        self.graph.spin_until(condition)


@pytest.fixture
def onlooker(tester, capfd):
    """Return an onlooker whose foreign nodes are gone after the test."""
    context = rclpy.Context()
    rclpy.init(context=context)
    made = Onlooker(tester, context, capfd)
    yield made
    for node in made.foreigners:
        node.destroy_node()
    rclpy.shutdown(context=context)


KINDS = [
    (MotionGenerator, {'goal': [1.0, 1.0]}), (WheelKinematics, {}), (DifferentialKinematics, BASE),
    (OmniKinematics, {}), (Localization, {}), (GranierProbe, {}), (GhostTrajectory, {}),
    (RouteFollowerNode, {}), (SequenceNode, {}), (Simulator, {}),
    (OmniSimulator, {'clock': 'follow'}), (DifferentialSimulator, {}),
]  # fmt: skip


@pytest.mark.parametrize(('kind', 'given'), KINDS, ids=lambda value: getattr(value, '__name__', ''))
def test_two_of_a_kind_stand_until_one_is_gone(onlooker, kind, given):
    first = onlooker.tester.start(kind, **given)
    second = onlooker.tester.start(kind, remap=['__node:=second'], **given)
    onlooker.until(lambda: not first.active and not second.active)
    for node in (first, second):
        name = node.get_name()
        onlooker.reported(node, ERROR, 'stopped:', f'/{first.get_name()}', '/second')
        onlooker.told('ERROR', f'[{name}]', '/second')
    onlooker.graph.executor.remove_node(second)
    onlooker.graph.nodes.remove(second)
    second.destroy_node()
    onlooker.until(lambda: first.active)


def test_two_of_one_name_are_told_apart_by_the_numbers_of_their_ends(onlooker):
    nodes = [onlooker.tester.start(DifferentialKinematics, **BASE) for _ in range(2)]
    onlooker.until(lambda: not any(node.active for node in nodes))
    text = onlooker.told('/wheels/command', 'GID')
    assert text.count('/differential_kinematics (GID ') == 4  # of its command, and of odom


def test_robots_with_namespaces_are_no_rivals(onlooker):
    robots = [
        onlooker.tester.start(DifferentialKinematics, remap=[f'__ns:={namespace}'], **BASE)
        for namespace in ('/oak', '/ash')
    ]
    for robot in robots:
        onlooker.reported(robot, OK)
        onlooker.reported(robot, OK)
    assert all(robot.active for robot in robots)


class Driven:
    """Wheels that turn, as an endless stream of twists tells them."""

    def __init__(self, onlooker):
        self.onlooker = onlooker
        self.commands = onlooker.tester.listen(JointState, 'wheels/command', 10)
        self.node = onlooker.tester.start(DifferentialKinematics, **PATIENT)
        self.twists = onlooker.tester.publisher(TwistStamped, 'cmd_vel')
        onlooker.tester.node.create_timer(0.02, self._send)
        onlooker.until(self.turn)

    def _send(self):
        message = TwistStamped()
        message.header.stamp = self.node.get_clock().now().to_msg()
        message.twist.linear.x = 0.5
        self.twists.publish(message)

    def turn(self):
        return bool(self.commands) and any(self.commands[-1].velocity)


def test_driven_wheels_stand_beside_a_second_commander_and_go_on_without_it(onlooker):
    driven = Driven(onlooker)
    rival = onlooker.foreign('motor_test')
    rival.create_publisher(JointState, 'wheels/command', 1)
    onlooker.until(lambda: not driven.node.active)
    onlooker.until(lambda: not driven.turn())
    driven.commands.clear()
    onlooker.reported(driven.node, ERROR, '/motor_test', '/differential_kinematics')
    assert not any(map(any, (command.velocity for command in driven.commands)))
    assert driven.node.port.graph.rivals
    onlooker.gone(rival)
    onlooker.until(driven.turn)


def test_beside_a_rival_nobody_can_activate_the_node(onlooker):
    node = onlooker.tester.start(DifferentialKinematics, **BASE)
    rival = onlooker.foreign('rival')
    rival.create_publisher(Odometry, 'odom', 1)
    onlooker.until(lambda: not node.active)
    assert node.trigger_activate().name == 'FAILURE'
    onlooker.told('cannot activate', '/rival')
    node.trigger_cleanup()  # the person wants it no more: it must not come back by itself
    onlooker.gone(rival)
    onlooker.reported(node, WARN, 'not active')


def test_a_tool_beside_the_node_is_told_and_let_be(onlooker):
    driven = Driven(onlooker)
    tool = onlooker.foreign('_agv_17')
    tool.create_publisher(JointState, 'wheels/command', 1)
    onlooker.told('/_agv_17', '/wheels/command', 'WARN')
    onlooker.reported(driven.node, WARN, '/_agv_17')
    assert driven.turn()


def test_a_player_is_known_by_its_services(onlooker):
    node = onlooker.tester.start(DifferentialKinematics, **BASE)
    player = onlooker.foreign('season_of_2014')
    player.create_service(Trigger, '~/play_next', lambda _, answer: answer)
    onlooker.until(lambda: 'season_of_2014' in str(node.get_service_names_and_types()))
    player.create_publisher(Odometry, 'odom', 1)
    onlooker.told('/season_of_2014', '/odom', 'WARN')
    assert node.active


def test_several_sources_of_cmd_vel_are_named_and_obeyed(onlooker):
    driven = Driven(onlooker)
    joystick = onlooker.foreign('joystick')
    joystick.create_publisher(TwistStamped, 'cmd_vel', 1)  # silent, at rest
    onlooker.told('/joystick', '/tester', 'all publish cmd_vel', 'WARN')
    driven.commands.clear()
    onlooker.until(driven.turn)
    report = onlooker.reported(driven.node, OK, '/joystick')
    assert driven.node.active
    assert report.message == 'driving'


@pytest.mark.parametrize('stamped', [True, False])
def test_a_twist_with_a_stamp_too_much_or_too_few(onlooker, stamped):
    node = onlooker.tester.start(DifferentialKinematics, stamped=stamped, **BASE)
    teleop = onlooker.foreign('teleop')
    kind = Twist if stamped else TwistStamped
    teleop.create_publisher(kind, 'cmd_vel', 1)
    words = '/cmd_vel: /teleop publishes geometry_msgs/msg/', f'set stamped:={not stamped}'.lower()
    onlooker.told(*words, 'WARN')
    onlooker.reported(node, WARN, *words)
    onlooker.gone(teleop)
    onlooker.reported(node, OK)


def test_the_sender_of_twists_tells_it_too(onlooker):
    node = onlooker.tester.start(GhostTrajectory)
    base = onlooker.foreign('base')
    base.create_subscription(Twist, 'cmd_vel', print, 1)
    onlooker.told('/base expects geometry_msgs/msg/Twist', 'set stamped:=false')
    assert node.active


def test_best_effort_where_reliable_is_asked_for(onlooker):
    node = onlooker.tester.start(DifferentialKinematics, **BASE)
    teleop = onlooker.foreign('teleop')
    teleop.create_publisher(TwistStamped, 'cmd_vel', BEST_EFFORT)
    onlooker.told('/teleop', 'best effort offered', 'let it publish reliable')
    onlooker.reported(node, WARN, 'let it publish reliable')


def test_reliable_asked_for_where_a_measurement_is_best_effort(onlooker):
    node = onlooker.tester.start(Localization)
    screen = onlooker.foreign('screen')
    screen.create_subscription(PoseWithCovarianceStamped, 'pose', print, 1)
    onlooker.told('nothing gets through to /screen', 'let it subscribe best effort')
    assert node.active


def test_any_topic_with_another_type(onlooker):
    onlooker.tester.start(Localization)
    onlooker.foreign('radio').create_publisher(Odometry, 'fix', 1)
    onlooker.told(
        '/fix: /radio publishes nav_msgs/msg/Odometry',
        'expects geometry_msgs/msg/PoseWithCovarianceStamped', 'give both the same type',
    )  # fmt: skip


def test_a_quiet_graph_is_hardly_asked(onlooker):
    node = onlooker.tester.start(WheelKinematics)
    onlooker.reported(node, WARN)
    asked = []
    ask = node.get_publishers_info_by_topic
    node.get_publishers_info_by_topic = lambda topic: asked.append(topic) or ask(topic)
    watch = node.port.graph._watch  # noqa: SLF001
    for _ in range(20):
        watch.look()
    assert len(asked) <= 20 * IN_TURN + 4


def test_a_node_says_once_what_it_lacks_and_once_in_a_short_line_that_it_is_well(
    tester, monkeypatch
):
    monkeypatch.setattr(graph_guard, 'PATIENCE', graph_guard.LOOKS_AROUND)
    told = tester.logs()
    tester.node.create_publisher(JointState, 'wheels/state', 1)
    tester.start(DifferentialKinematics, **PATIENT)
    line = tester.wait(told, lambda m: m.msg.startswith('active')).msg
    assert line == 'active, but nobody publishes cmd_vel yet'  # and not that nobody says STOP
    tester.node.create_publisher(TwistStamped, 'cmd_vel', 1)
    line = tester.wait(told, lambda m: m.msg.startswith('active: ')).msg
    assert line == 'active: cmd_vel, wheels/state -> wheels/command, odom'
    tester.graph.spin_for(1.0)
    assert sum(m.msg.startswith('active') for m in told) == 2
