"""What the three nodes share that drive by a pose: limits, a blocked robot, a second activation."""

from __future__ import annotations

from math import hypot

import pytest

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger

from agv_motion.nodes.ghost_trajectory import GhostTrajectory
from agv_motion.nodes.route_follower import RouteFollowerNode
from agv_motion.nodes.sequence import SequenceNode
from agv_motion.planar import Pose
from agv_motion.ros.qos import LATCHED

SOON = {'blocked__after': 0.5, 'report_after': 5.0, 'stop_after': 10.0}
LONG = 'actions:\n  - go_to: {x: 50.0, y: 0.0, heading: 0, speed: 0.5}\n'
SLOW_WHEELS = {
    GhostTrajectory: {'follow__ghost__wheel_speed': 0.2, 'follow__kanayama__along': 100.0},
    RouteFollowerNode: {'limits__wheel_speed': 0.2, 'follow__omega_dphi': [0.0, 0.0, 0.1, 9.0]},
    SequenceNode: {'tracking__ghost__wheel_speed': 0.2, 'tracking__kanayama__along': 100.0},
}


class Driver:
    """One of the nodes, its robot, and how it is told to go far along x."""

    def __init__(self, tester, kind, file, **parameters):
        self.tester, self.kind = tester, kind
        name, topic = {
            GhostTrajectory: ('ghost_trajectory', 'ghost/state'),
            RouteFollowerNode: ('route_follower', 'route/state'),
            SequenceNode: ('sequence', 'sequence/state'),
        }[kind]
        if kind is SequenceNode:
            file.write_text(LONG)
            parameters['file'] = str(file)
        self.name = name
        self.states = tester.listen(String, topic, LATCHED)
        self.robot = tester.driven_robot(step=0.04)
        self.node = tester.start(kind, **({'rate': 25.0} | SOON | parameters))
        self.robot.find()
        if kind is GhostTrajectory:
            self.goal = tester.publisher(PoseStamped, 'goal_pose')
        elif kind is RouteFollowerNode:
            self.goal = tester.publisher(Path, 'route')
        tester.graph.spin_until(lambda: not self.node.plain.lost)

    def go(self):
        """Tell it to go 50 m ahead."""
        far = PoseStamped()
        far.pose.position.x, far.pose.orientation.w = self.robot.pose.x + 50.0, 1.0
        if self.kind is SequenceNode:
            assert self.ask('start').success
        elif self.kind is GhostTrajectory:
            self.goal.publish(far)
        else:
            self.goal.publish(Path(poses=[PoseStamped(), far]))

    def ask(self, service, data=None):
        kind = Trigger if data is None else SetBool
        request = kind.Request() if data is None else kind.Request(data=data)
        return self.tester.ask(kind, f'{self.name}/{service}', request)

    def says(self, words):
        return self.tester.wait(self.states, lambda m: words in m.data).data

    def release(self):
        """Let it go on, as its words say."""
        if self.kind is SequenceNode:
            self.go()
        else:
            self.ask('lock' if self.kind is GhostTrajectory else 'pause', data=False)


@pytest.fixture(params=[GhostTrajectory, RouteFollowerNode, SequenceNode])
def kind(request):
    return request.param


@pytest.fixture
def driver(kind, tester, tmp_path):
    return lambda **parameters: Driver(tester, kind, tmp_path / 'far.yaml', **parameters)


def test_held_it_is_blocked_stands_and_goes_on_when_a_person_says_so(driver):
    far = driver()
    far.go()
    far.robot.moves()
    far.robot.stuck = True
    assert 'blocked: told to move by' in far.says('blocked: ')
    far.robot.stands()
    assert far.node.plain.diagnose().level == b'\x02'
    far.robot.stuck = False
    far.tester.graph.spin_for(0.3)
    assert not any(far.robot.commands[-1])
    far.robot.commands.clear()
    far.release()
    far.robot.moves()
    first = next(twist for twist in far.robot.commands if any(twist))
    assert hypot(first.vx, first.vy) < 0.2  # of 0.5 m/s and more: five cycles of a ramp at most


def test_held_it_tries_again_by_itself_where_it_may(driver):
    far = driver(blocked__then='retry', blocked__retry_after=0.3)
    far.go()
    far.robot.moves()
    far.robot.stuck = True
    assert 'trying again in 0.3 s' in far.says('blocked: ')
    far.robot.stands()
    far.robot.moves()
    far.robot.stuck = False
    start = far.robot.pose.x
    far.tester.graph.spin_until(lambda: far.robot.pose.x > start + 0.2)


def test_no_command_passes_a_limit(kind, driver):
    """0.2 m/s at the wheels, where the gains and the tables ask for more."""
    far = driver(**SLOW_WHEELS[kind], blocked__after=0.0)
    far.go()
    far.robot.moves()
    x, y, _ = far.robot.pose
    far.robot.pose, far.robot.stuck = Pose(x - 0.05, y + 0.1, 0.2), True
    far.robot.commands.clear()
    far.tester.graph.spin_until(lambda: len(far.robot.commands) > 60)
    rims = [hypot(t.vx, t.vy) + 0.15 * abs(t.wz) for t in far.robot.commands]
    assert max(rims) == pytest.approx(0.2)


def test_activated_again_it_stands_until_it_is_told_anew(driver, capfd):
    far = driver(report_after=1.2, stop_after=1.3)
    far.go()
    far.robot.moves()
    far.node.trigger_deactivate()
    far.tester.graph.spin_until(lambda: not any(far.robot.commands[-1]))
    far.tester.graph.spin_until(lambda: far.states[-1].data == 'not active')
    for _ in range(70):  # odom goes on meanwhile
        far.robot.report()
        far.tester.graph.spin_for(0.02)
    far.robot.commands.clear()
    capfd.readouterr()  # nobody told odom while a busy machine took its time to begin
    far.node.trigger_activate()
    for _ in range(30):
        far.robot.report()
        far.tester.graph.spin_for(0.02)
    assert not any(map(any, far.robot.commands))
    assert far.states[-1].data != 'not active'
    assert 'no odom for' not in capfd.readouterr().err
    far.go()
    far.robot.moves()
    first = next(twist for twist in far.robot.commands if any(twist))
    assert hypot(first.vx, first.vy) < 0.2  # of 0.5 m/s and more: five cycles of a ramp at most
