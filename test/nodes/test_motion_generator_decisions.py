"""When the motion node thinks: at once when something is new, and of the hour within a second."""

from __future__ import annotations

from datetime import datetime, timezone

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseWithCovarianceStamped, Vector3, Vector3Stamped

from agv_motion.motion.navigation.reservations.reservation import MessageId, Reservation
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.reservations import reservation_message

SECOND = 1_000_000_000
CLOSING = int(datetime(2015, 6, 15, 18, 0, tzinfo=timezone.utc).timestamp()) * SECOND
SILENT = {'report_after': 100.0, 'stop_after': 100.0}
FIXED = {'goals.strategy': 'fixed', 'goal': (9.0, 0.0)}


class Tree:
    """A motion node in a graph of its own, and what it said [s since the beginning]."""

    def __init__(self, start, **given):
        self.states, self.twists, self.start = [], [], start
        self.graph = InProcessGraph(self.record, start)
        InProcessNode(self.graph, MotionGenerator, SILENT | FIXED | given)
        self.graph.start()

    def record(self, publisher, stamp, data):
        message, seconds = codec(publisher.kind).decode(data), (stamp - self.start) / SECOND
        if publisher.topic == '/state':
            self.states.append((seconds, message.data))
        elif publisher.topic == '/cmd_vel':
            linear = message.twist.linear
            self.twists.append((seconds, linear.x, linear.y))

    def stand(self, seconds, y=0.0):
        message = PoseWithCovarianceStamped()
        message.pose.pose.position.y = y
        self._feed(seconds, '/pose', message)

    def flow(self, seconds, speed=1.0):
        self._feed(
            seconds, '/granier/sap_flow', Vector3Stamped(vector=Vector3(x=speed, y=0.5, z=0.5))
        )

    def _feed(self, seconds, topic, message):
        stamp = self.start + int(seconds * SECOND)
        self.graph.feed(topic, stamp, codec(type(message)).encode(message))


def test_the_closing_hour_is_noticed_though_nothing_is_new():
    hours = {'schedule.enabled': True, 'schedule.time_zone': 'UTC'}
    tree = Tree(CLOSING - 10 * SECOND, **hours)
    tree.stand(0.05)
    tree.flow(0.05)
    tree.graph.run(CLOSING + 2 * SECOND)
    (walked, walking), (rested, resting) = tree.states[-2:]
    assert 'walking' in walking
    assert walked <= 0.1
    assert 'resting: closed' in resting
    assert 10.0 <= rested <= 11.1


def test_a_new_pose_and_a_new_flow_count_at_once():
    tree = Tree(CLOSING)
    tree.stand(0.05)
    tree.flow(0.05)
    tree.stand(0.35, y=9.0)
    tree.flow(0.55, 0.0)
    tree.graph.run(CLOSING + SECOND)
    straight = [(x, y) for t, x, y in tree.twists if 0.05 < t < 0.35]
    aside = [(x, y) for t, x, y in tree.twists if 0.35 <= t < 0.55]
    assert straight
    assert all(x > 0.0 and y == pytest.approx(0.0) for x, y in straight)
    assert len(aside) == 2
    assert all(y == pytest.approx(-x) for x, y in aside)
    assert all(x > 0.0 for x, _ in aside)
    assert tree.twists[-1][1:] == (0.0, 0.0)


def test_commands_go_on_between_thoughts():
    tree = Tree(CLOSING)
    tree.stand(0.05)
    tree.flow(0.05)
    tree.graph.run(CLOSING + 5 * SECOND)
    assert len(tree.twists) >= 50
    assert all(x > 0.0 for t, x, _ in tree.twists if t > 0.05)


@pytest.mark.parametrize('recorded', [False, True])
def test_on_a_recording_a_tree_takes_its_own_word_for_that_of_no_other(tmp_path, recorded):
    """Live, another of the same name is a mistake of whoever set it up."""
    zone = tmp_path / 'zone.yaml'
    zone.write_text('boundary: [[-3, -3], [12, -3], [12, 3], [-3, 3]]\n', encoding='utf-8')
    sharing = {'share_zone': True, 'tree_name': 'oak', 'traffic.expected': ('ash',)}
    tree = Tree(CLOSING, zone_file=str(zone), **sharing)
    tree.graph.recorded = {'/reservations'} if recorded else ()
    tree.stand(0.05)
    tree.flow(0.05)
    own = Reservation('oak', MessageId(1, 1), 1.48, ((0.0, 0.0),))
    tree._feed(0.1, '/reservations', reservation_message(own, 'map', CLOSING))  # noqa: SLF001
    told = [text for text in tree.graph.complaints if "calls itself 'oak'" in text]
    assert bool(told) is not recorded
