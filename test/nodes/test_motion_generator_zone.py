"""Another zone, other hours and a rest until a time while the tree walks, all over parameters."""

from __future__ import annotations

import json

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseWithCovarianceStamped, Vector3, Vector3Stamped
from std_msgs.msg import Bool

from agv_motion.errors import AgvMotionError
from agv_motion.motion.navigation.reservations.reservation import MessageId, Reservation
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.reservations import reservation_message

SECOND = 1_000_000_000
NOON = 1434369600  # 2015-06-15 12:00 UTC, a Monday
YARD = 'boundary: [[0, 0], [20, 0], [20, 15], [0, 15]]\nmargin: 0.5\nhome: [2, 2]\n'
GIVEN = {
    'report_after': 100.0, 'stop_after': 100.0, 'goal': (10.0, 7.5), 'platform_radius': 1.0,
    'rest.arrival': 0.5,
}  # fmt: skip


class Tree:
    """A motion node in a graph of its own, and the last message on each of its topics."""

    def __init__(self, tmp_path, **given):
        zone = tmp_path / 'zone.yaml'
        zone.write_text(YARD, encoding='utf-8')
        self.last, self.states, self.now = {}, [], 0.0
        self.graph = InProcessGraph(self.record, NOON * SECOND)
        self.node = InProcessNode(
            self.graph, MotionGenerator, {'zone_file': str(zone)} | GIVEN | given
        )
        self.graph.start()

    def record(self, publisher, _, data):
        self.last[publisher.topic] = message = codec(publisher.kind).decode(data)
        if publisher.topic == '/state':
            self.states.append(message.data)

    def live(self, x=5.0, y=5.0, flow=(1.0, 0.5, 0.5)):
        pose = PoseWithCovarianceStamped()
        pose.pose.pose.position.x, pose.pose.pose.position.y = x, y
        self.feed('/pose', pose)
        s1, s2, s3 = flow
        self.feed('/granier/sap_flow', Vector3Stamped(vector=Vector3(x=s1, y=s2, z=s3)))
        return self.diagnosed()

    def feed(self, topic, message, seconds=0.05):
        self.now += seconds
        stamp = int((NOON + self.now) * SECOND)
        self.graph.feed(topic, stamp, codec(type(message)).encode(message))

    def set(self, **changes):
        self.node.set_parameters({n.replace('__', '.'): v for n, v in changes.items()})

    def diagnosed(self):
        values = self.node.plain.diagnose().values
        return values['activity'], values['because']

    @property
    def zone(self):
        return json.loads(self.last['/zone'].data)


@pytest.fixture
def make(tmp_path):
    return lambda **given: Tree(tmp_path, **given)


def test_the_zone_in_force_is_told(make):
    tree = make()
    assert tree.zone == {
        'boundary': [[0, 0], [20, 0], [20, 15], [0, 15]], 'holes': [], 'translation_only': [],
        'margin': 0.5, 'clearance_from': 'rim', 'home': [2, 2],
    }  # fmt: skip


def test_another_zone_counts_at_once_and_is_told(make):
    tree = make(**{'goals.strategy': 'memory'})
    tree.live()
    tree.set(zone='{boundary: [[0, 0], [12, 0], [12, 12], [0, 12]], margin: 0.2}')
    assert tree.zone['boundary'] == [[0, 0], [12, 0], [12, 12], [0, 12]]
    assert tree.zone['home'] == [2, 2], 'where it is parked stays, where the text does not say'
    grid = tree.last['/memory/sap_flow']
    assert (grid.info.width, grid.info.height) == (48, 48)
    tree.live(11.5, 6.0)
    assert tree.states[-1].startswith('stopped: the tree has the rim 0.50 m over an edge')
    assert tree.diagnosed() == ('stopped', 'zone')


def test_what_is_remembered_of_places_that_are_still_there_stays(make, tmp_path):
    file = tmp_path / 'memory'
    tree = make(**{'goals.strategy': 'memory', 'memory_file': str(file)})
    tree.live(5.1, 5.1, (1.0, 0.5, 0.75))
    before = tree.node.plain._tree.agent.memory  # noqa: SLF001
    tree.set(zone='{boundary: [[1, 1], [12, 1], [12, 12], [1, 12]], margin: 0.2, home: [4, 4]}')
    memory = tree.node.plain._tree.agent.memory  # noqa: SLF001
    assert memory is not before
    assert memory.flow[memory.cells.cell_of(5.1, 5.1)] == 0.75
    tree.graph.stop()
    assert file.exists()
    assert (tmp_path / 'memory.other_zone').exists()


@pytest.mark.parametrize(
    ('zone', 'said'),
    [
        ('{boundary: [[0, 0], [4, 0], [4, 4], [0, 4]], margin: 0.2}',
         r'the tree, at \(5\.00, 5\.00\), lies outside the zone .*drive it in first'),
        ('{boundary: [[3, 3], [12, 3], [12, 12], [3, 12]], margin: 0.2}', r'home .*lies outside'),
        ('{boundary: [[0, 0], [.nan, 0], [20, 15]]}', 'corner 2: x = nan: must be a finite'),
        ('{boundary: [[0, 0], [1e9, 0], [20, 15]]}', 'further than'),
        ('{boundary: [[0, 0], [20, 15], [20, 0], [0, 15]]}', 'is no polygon: Self-intersection'),
        ('{boundary: [[0, 0], [20, 0], [20, 15], [0, 15]], margin: -1}', 'margin = -1.0 m'),
        ('{boundary: [[0, 0], [20, 0], [20, 15], [0, 15]], marg: 1}', 'expected boundary, and of'),
        ('{"boundary": [[0, 0], [20, 0], [20, 15], [0, 15]], "home": [NaN, 1]}', 'home: x'),
        ('[', 'no YAML'),
        (' ', 'the text is empty'),
        ('x' * 300_000, 'at most 200000'),
        (f'{{boundary: {[[k / 100, k * k / 1e4] for k in range(1200)]}}}', '3000 values'),
    ],
)  # fmt: skip
def test_a_zone_that_cannot_be_is_refused_and_nothing_changes(make, zone, said):
    tree = make()
    tree.live()
    told = tree.zone
    with pytest.raises(AgvMotionError, match=said):
        tree.set(zone=zone)
    assert tree.zone == told
    assert tree.node.plain.parameters.zone == ''
    assert tree.live() == ('walking', 'goal')


def test_without_a_pose_no_zone_is_taken(make):
    tree = make()
    with pytest.raises(AgvMotionError, match='no pose, so nobody knows'):
        tree.set(zone=YARD)


def test_an_empty_text_goes_back_to_the_file(make):
    tree = make()
    tree.live()
    tree.set(zone='{boundary: [[0, 0], [12, 0], [12, 12], [0, 12]], margin: 0.2}')
    tree.set(zone='')
    assert tree.zone['boundary'][1] == [20, 0]


def test_among_others_the_tree_lets_go_of_its_floor_and_asks_anew(make):
    tree = make(**SHARED)
    other = walked(tree, (15.0, 10.0))
    assert other.held[-1] != other.held[0]
    tree.set(zone='{boundary: [[0, 0], [18, 0], [18, 12], [0, 12]], margin: 0.2}')
    right = tree.node.plain._tree.exchange._navigator.right  # noqa: SLF001
    assert (len(right.held), right.requested) == (1, ())
    assert right is other, 'what it knows of the others, and its run, stay'


def test_a_zone_that_leaves_another_tree_out_is_refused(make):
    tree = make(**SHARED)
    right = walked(tree, (15.0, 10.0))
    held = right.held
    with pytest.raises(AgvMotionError, match=r'ash stands at \(15\.00, 10\.00\)'):
        tree.set(zone='{boundary: [[0, 0], [12, 0], [12, 12], [0, 12]], margin: 0.2}')
    assert right.held == held


def test_another_floor_than_that_of_a_tree_beside_it_is_told(make):
    from std_msgs.msg import String

    tree = make(**SHARED)
    walked(tree, (15.0, 10.0))
    assert 'zone differs from' not in tree.node.plain.diagnose().values
    other = tree.zone | {'margin': 0.9, 'home': None}
    tree.feed('/ash/zone', String(data=json.dumps(other)))
    assert 'zone differs from' not in tree.node.plain.diagnose().values
    tree.feed('/ash/zone', String(data=json.dumps(other | {'holes': [[[8, 8], [9, 8], [8, 9]]]})))
    assert tree.node.plain.diagnose().values['zone differs from'] == 'ash'


SHARED = {
    'share_zone': True, 'tree_name': 'oak', 'traffic.expected': ('ash',), 'traffic.listen': 0.0,
}  # fmt: skip


def walked(tree, place):
    """Let the tree walk beside another that stands at ``place`` and answers; return its right."""
    for number in range(20):
        tree.live()
        right = tree.node.plain._tree.exchange._navigator.right  # noqa: SLF001
        answer = Reservation(
            'ash', MessageId(7, number), 1.5, (place,),
            received={'oak': MessageId(right.run, right._number)},  # noqa: SLF001
        )  # fmt: skip
        stamp = int((NOON + tree.now) * SECOND)
        tree.feed('/reservations', reservation_message(answer, 'map', stamp), 0.2)
    return right


def test_a_rest_until_a_time(make):
    tree = make()
    assert tree.live() == ('walking', 'goal')
    tree.set(rest_until=NOON + 600.0)
    assert tree.live() == ('resting', 'person')
    assert tree.states[-1] == 'resting until Mon 12:10, as asked'
    twist = tree.last['/cmd_vel'].twist
    assert (twist.linear.x, twist.linear.y, twist.angular.z) == (0.0, 0.0, 0.0)
    tree.now = 599.0
    assert tree.live() == ('resting', 'person')
    tree.now = 601.0
    assert tree.live() == ('walking', 'goal')


def test_a_rest_ends_with_0(make):
    tree = make()
    tree.set(rest_until=NOON + 600.0)
    assert tree.live() == ('resting', 'person')
    tree.set(rest_until=0.0)
    assert tree.live() == ('walking', 'goal')


@pytest.mark.parametrize(
    ('value', 'said'),
    [
        (NOON - 1.0, r'rest_until = 1434369599 s is past: it is 1434369600 s now'),
        (NOON * 1000.0 + 1.0, 'must lie in'),
        (float('nan'), 'finite'),
        (-1.0, 'must lie in'),
    ],
)
def test_a_rest_until_no_time_to_come_is_refused(make, value, said):
    tree = make()
    with pytest.raises(AgvMotionError, match=said):
        tree.set(rest_until=value)
    assert tree.live() == ('walking', 'goal')


def test_hours_change_at_run_time_and_all_that_go_together_at_once(make):
    """From 10:00-18:00 to 18:00-20:00: each half alone would be no hours at all."""
    tree = make(**{'schedule.enabled': True})
    assert tree.live() == ('walking', 'goal')
    tree.set(schedule__opens='18:00', schedule__closes='20:00')
    assert tree.live() == ('closed', 'hours')
    assert tree.states[-1] == 'resting: closed until Mon 18:00'
    with pytest.raises(AgvMotionError, match="closes = '25:00'"):
        tree.set(schedule__closes='25:00')
    tree.set(schedule__enabled=False)
    assert tree.live() == ('walking', 'goal')


def test_pause_and_a_probe_that_cannot_be_believed_are_told_for_programs(make):
    tree = make()
    tree.live()
    tree.feed('/granier/valid', Bool(data=False))
    assert tree.diagnosed() == ('resting', 'probes')
