"""Two real `motion_generator` nodes in one zone: they meet head on, and both get where they go."""

from __future__ import annotations

import time
from math import hypot

import pytest

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseWithCovarianceStamped, TwistStamped, Vector3Stamped
from rosgraph_msgs.msg import Clock
from visualization_msgs.msg import MarkerArray

from agv_motion.motion.navigation.reservations.reservation import MessageId, Reservation
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.reservation_exchange import WAYS
from agv_motion.planar import REST, Pose, integrate
from agv_motion.ros.messages import fill_pose, stamp_of, twist_of
from agv_motion.ros.qos import COMMAND, SENSOR
from agv_motion.ros.reservations import reservation_message
from agv_motion.ros.run import StartError

YARD = 'boundary: [[0, 0], [7, 0], [7, 4], [0, 4]]\nmargin: 0.4\n'
BODY, MARGIN = 0.3, 0.1
SMALL = {
    'traffic__margin': MARGIN, 'traffic__tolerance': 0.05,
    'traffic__listen': 0.5, 'platform_radius': BODY, 'linear_speed': 0.6, 'rest__arrival': 0.3,
    'limits__v_rate': 5.0, 'share_zone': True, 'traffic__expected': ['oak', 'ash'],
}  # fmt: skip


class Tree:
    """A tree that goes exactly where it is told."""

    def __init__(self, tester, zone, name, place, goal, **given):
        self.tester, self.pose, self.goal, self.twist = tester, Pose(*place, 0.0), goal, REST
        self._commanded = False
        node, graph = tester.node, tester.graph
        self._poses = node.create_publisher(PoseWithCovarianceStamped, f'/{name}/pose', SENSOR)
        self._flows = node.create_publisher(Vector3Stamped, f'/{name}/granier/sap_flow', SENSOR)
        node.create_subscription(TwistStamped, f'/{name}/cmd_vel', self._on_command, COMMAND)
        self.node = tester.start(
            MotionGenerator, remap=[f'__ns:=/{name}'], zone_file=zone, goal=list(goal),
            **(SMALL | given),
        )  # fmt: skip
        graph.spin_until(lambda: self._poses.get_subscription_count() >= 1)

    def _on_command(self, message):
        self.twist, self._commanded = twist_of(message.twist), True

    def live(self, duration):
        """Move for a while, and tell where it is and that the sap flows.

        A hiccup of the machine is none of the tree: it drives no farther than it is looked after,
        and only after a command.
        """
        if self._commanded:
            self.pose = integrate(self.pose, self.twist, min(duration, 0.05))
            self._commanded = False
        pose = PoseWithCovarianceStamped()
        pose.header.frame_id = 'map'
        fill_pose(pose.pose.pose, self.pose)
        self._poses.publish(pose)
        flow = Vector3Stamped()
        flow.vector.x, flow.vector.y, flow.vector.z = 1.0, 0.5, 0.5
        self._flows.publish(flow)

    def diagnose(self):
        return self.node.plain.diagnose()

    def away(self):
        return hypot(self.pose.x - self.goal[0], self.pose.y - self.goal[1])


@pytest.fixture
def zone(tmp_path):
    path = tmp_path / 'zone.yaml'
    path.write_text(YARD)
    return str(path)


def test_two_that_meet_head_on_keep_clear_and_arrive(tester, zone):
    given = {'traffic__tolerance': 0.15}  # commands come late where the machine is busy
    oak = Tree(tester, zone, 'oak', (1.0, 2.0), (6.0, 2.0), **given)
    ash = Tree(tester, zone, 'ash', (6.0, 1.9), (1.0, 2.1), **given)
    nearest, end, before = 9.0, time.monotonic() + 100.0, time.monotonic()
    while max(oak.away(), ash.away()) > 0.35:
        assert time.monotonic() < end, (oak.diagnose(), ash.diagnose())
        now = time.monotonic()
        for tree in (oak, ash):
            tree.live(now - before)
        before = now
        nearest = min(nearest, hypot(oak.pose.x - ash.pose.x, oak.pose.y - ash.pose.y))
        tester.graph.spin_for(0.05)
    assert nearest >= 2.0 * BODY + MARGIN
    assert oak.diagnose().values['other trees'] == 'ash'


def test_a_tree_tells_where_it_is_and_parks_at_the_end(tester, zone):
    reservations = tester.listen(MarkerArray, '/reservations', WAYS)
    oak = Tree(tester, zone, 'oak', (1.0, 2.0), (6.0, 2.0))
    for _ in range(10):
        oak.live(0.0)
        tester.graph.spin_for(0.05)
    held = tester.wait(reservations).markers[0]
    assert (held.ns, held.points[0].x, held.points[0].y) == ('oak', 1.0, 2.0)
    oak.node.trigger_deactivate()
    tester.wait(reservations, lambda m: '"parked": true' in m.markers[0].text)


def live_until(tester, trees, condition, seconds=60.0):
    """Let ``trees`` live on until something holds."""
    end = before = time.monotonic()
    while not condition():
        now = time.monotonic()
        assert now < end + seconds, [tree.diagnose() for tree in trees]
        for tree in trees:
            tree.live(now - before)
        before = now
        tester.graph.spin_for(0.05)


def stands(tree, word):
    """Return whether a tree does not move, and says why with a ``word``."""
    told = tree.diagnose()
    return tree.twist == REST and word in told.values['nobody moves'] and word in told.message


def test_two_of_one_name_stand_and_say_so_until_one_is_gone(tester, zone):
    """Both namespaces differ, as by a copied configuration."""
    given = {'tree_name': 'oak', 'traffic__silent_after': 1.0, 'traffic__expected': ['ash']}
    one = Tree(tester, zone, 'one', (1.0, 2.0), (6.0, 2.0), **given)
    other = Tree(tester, zone, 'other', (6.0, 2.0), (1.0, 2.0), **given)
    both = [one, other]
    live_until(tester, both, lambda: all(stands(tree, "calls itself 'oak'") for tree in both))
    assert one.pose == Pose(1.0, 2.0, 0.0)
    other.node.trigger_deactivate()
    live_until(tester, [one], lambda: one.diagnose().values['nobody moves'] == 'no')


def test_a_reservation_that_is_refused_is_told_and_the_tree_stands_for_a_while(tester, zone):
    oak = Tree(
        tester, zone, 'oak', (1.0, 2.0), (6.0, 2.0), traffic__silent_after=1.0,
        traffic__expected=['ash'],
    )  # fmt: skip
    messages = tester.node.create_publisher(MarkerArray, '/reservations', WAYS)
    reservations = tester.listen(MarkerArray, '/reservations', WAYS)
    live_until(tester, [oak], lambda: reservations and messages.get_subscription_count() >= 1)
    messages.publish(MarkerArray())
    live_until(tester, [oak], lambda: stands(oak, '0 markers are no reservation of a tree'))
    live_until(tester, [oak], lambda: oak.diagnose().values['nobody moves'] == 'no')


def test_who_was_heard_is_waited_for_after_a_restart(tester, zone, tmp_path):
    """Oak expects nobody but ash; after it has heard pine it waits for both."""
    file = tmp_path / 'peers'
    given = {'peers_file': str(file), 'traffic__expected': ['ash']}
    oak = Tree(tester, zone, 'oak', (1.0, 2.0), (6.0, 2.0), **given)
    pine = Tree(tester, zone, 'pine', (6.0, 2.0), (1.0, 2.0))
    live_until(tester, [oak, pine], file.exists)
    for tree in (oak, pine):
        tree.node.trigger_shutdown()
    given['traffic__expected'] = ['oak']  # nobody by itself
    again = Tree(tester, zone, 'oak', (1.0, 2.0), (6.0, 2.0), **given)
    live_until(tester, [again], lambda: 'waits for the answer of pine' in again.diagnose()[1])
    assert again.pose == Pose(1.0, 2.0, 0.0)


def test_a_tree_whose_simulated_clock_stands_still_speaks_and_finds_out_who_is_silent(tester, zone):
    given = {'use_sim_time': True, 'traffic__silent_after': 1.0, 'traffic__expected': ['ash']}
    oak = Tree(tester, zone, 'oak', (1.0, 2.0), (6.0, 2.0), **given)
    clock = tester.publisher(Clock, '/clock', SENSOR)
    messages = tester.node.create_publisher(MarkerArray, '/reservations', WAYS)
    reservations = tester.listen(MarkerArray, '/reservations', WAYS)
    ash = Reservation('ash', MessageId(1, 1), 0.35, ((6.0, 2.0),))

    def received():
        clock.publish(Clock(clock=stamp_of(round((1e3 + time.monotonic()) * 1e9))))
        messages.publish(reservation_message(ash, 'map', 0))
        return oak.diagnose().values['other trees'] == 'ash'

    live_until(tester, [oak], received)
    live_until(tester, [oak], lambda: oak.node.port.clock.fault)
    reservations.clear()
    live_until(tester, [oak], lambda: len({m.markers[0].text for m in reservations}) >= 3)
    live_until(tester, [oak], lambda: oak.diagnose().values['other trees'] == 'ash (silent)')
    assert oak.twist == REST


def test_a_tree_whose_pose_jumps_to_and_fro_tells_both_places_and_stands(tester, zone):
    given = {'traffic__silent_after': 1.5, 'traffic__expected': ['ash']}
    oak = Tree(tester, zone, 'oak', (1.0, 2.0), (6.0, 2.0), **given)
    reservations = tester.listen(MarkerArray, '/reservations', WAYS)

    def told(*places):
        tells = [[(p.x, p.y) for p in m.markers[0].points] for m in reservations[-1:]]
        return bool(tells) and all(place in tells[0] for place in places)

    live_until(tester, [oak], lambda: told((1.0, 2.0)))
    oak.pose = Pose(4.0, 3.0, 0.0)
    live_until(tester, [oak], lambda: told((4.0, 3.0), (1.0, 2.0)))
    oak.pose = Pose(1.0, 2.0, 0.0)
    live_until(tester, [oak], lambda: reservations.clear() or stands(oak, 'off its way'))
    live_until(tester, [oak], lambda: told((4.0, 3.0), (1.0, 2.0)))
    live_until(tester, [oak], lambda: told((1.0, 2.0)) and not told((4.0, 3.0)))
    live_until(tester, [oak], lambda: oak.diagnose().values['nobody moves'] == 'no')


def test_a_tree_that_knows_of_no_other_does_not_start(tester, zone, tmp_path):
    """Where the network is slow it would walk into one that it does not hear yet."""
    for file in ('', str(tmp_path / 'none')):
        with pytest.raises(StartError):
            tester.start(
                MotionGenerator, share_zone=True, tree_name='oak', zone_file=zone,
                traffic__expected=['oak'], peers_file=file,
            )  # fmt: skip


def test_a_tree_without_name_or_zone_does_not_start(tester, zone):
    with pytest.raises(StartError):
        tester.start(MotionGenerator, share_zone=True, zone_file=zone, traffic__expected=['ash'])
    with pytest.raises(StartError):
        tester.start(MotionGenerator, share_zone=True, tree_name='oak')
