"""The pictures of the demos fit into the terminal, and show all that they are to show."""

from __future__ import annotations

import io

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseStamped, TwistStamped, Vector3Stamped
from nav_msgs.msg import Odometry
from rich.console import Console
from rich.text import Text
from sensor_msgs.msg import JointState
from std_msgs.msg import String

from agv_motion.demo.drive_view import DriveView
from agv_motion.demo.map_view import Room
from agv_motion.demo.tree_view import TreeView
from agv_motion.demo.trees_view import TreesView
from agv_motion.demo.zone_map import ZoneMap
from agv_motion.motion.navigation.zone_file import load_zone
from agv_motion.nodes.simulator import SimulatorParameters
from agv_motion.ros.config import find_config

SIZES = [(80, 24), (200, 50)]
NOW = 1_434_366_000.0


class Heard:
    """What a recorder has heard."""

    def __init__(self):
        self.messages = {}

    def latest(self, topic):
        return self.messages.get(topic)

    def hear_tree(self, prefix='', x=7.25, speed=-1e-6):
        """Hear all topics of a tree that hardly rolls back."""
        odometry, goal, flow = Odometry(), PoseStamped(), Vector3Stamped()
        odometry.pose.pose.position.x, odometry.pose.pose.position.y = x, 5.5
        odometry.pose.pose.orientation.w = 1.0
        goal.pose.position.x, goal.pose.position.y = 10.0, 7.5
        flow.vector.x, flow.vector.y, flow.vector.z = 0.42, 1.0, -1e-4
        water = Vector3Stamped()
        water.vector.x, water.vector.y, water.vector.z = 3.214, 1.0, 10.3
        twist = TwistStamped()
        twist.twist.linear.x, twist.twist.angular.z = -speed, speed
        names = [f'turret_{i}_{part}' for part in ('steering', 'wheel') for i in range(3)]
        joints = JointState(name=names, position=[0.0] * 6, velocity=[speed] * 6)
        state = String(data='walking to (10.00, 7.50): 3.3 m to go, the sap flow is low there')
        self.messages |= {
            f'{prefix}ground_truth': odometry, f'{prefix}goal': goal, f'{prefix}state': state,
            f'{prefix}granier/sap_flow': flow, f'{prefix}cmd_vel': twist, 'odom': odometry,
            f'{prefix}turrets/state': joints, f'{prefix}granier/water_use_today': water,
        }  # fmt: skip


def shown(view, factor, columns, rows):
    """Return the lines of a picture on a terminal of a size."""
    console = Console(width=columns, height=rows, file=io.StringIO(), force_terminal=False)
    console.print(view.draw(NOW, factor, Room(columns, rows - 2)))
    return console.file.getvalue().splitlines()


@pytest.fixture
def zone():
    return load_zone(find_config('zone_outdoor.yaml'), 1.3)


@pytest.mark.parametrize(('columns', 'rows'), SIZES)
def test_a_tree(zone, columns, rows):
    heard = Heard()
    view = TreeView(heard, zone, SimulatorParameters(), drinks=True)
    before = shown(view, 0.0, columns, rows)
    heard.hear_tree()
    after = shown(view, 60.0, columns, rows)
    for picture in before, after:
        assert len(picture) <= rows - 2
        assert max(map(len, picture)) <= columns
        assert ' 0.0 times' not in '\n'.join(picture)
    text = '\n'.join(after)
    words = (
        'state', 'walking to (10.00,', 'pose     7.25   5.50 m    0°', 'wheel0', 'wheel2',
        'drank   3.21 L  1.00 to 10.30',
        'speed  ██████           0.42', ' 60.0 times real time', '♣', '✕', 'UTC',
    )  # fmt: skip
    for word in words:
        assert word in text
    assert '-0' not in text
    column = {line.index('│', 3) for line in before + after if line.startswith('│')}
    assert len(column) == 1  # nothing jumps when numbers come
    if columns > 80:
        assert len(after) > 30
        assert min(column) > 80


@pytest.mark.parametrize('litres', [(0.0, 0.0, 0.0), (99.0, 9.999, 99.99), (120.0, 99.996, 999.9),
                                    (400.0, 130.0, 1250.0)])  # fmt: skip
def test_what_it_drank_is_of_one_width_and_not_told_without_an_area(zone, litres):
    heard = Heard()
    heard.hear_tree()
    vector = heard.messages['granier/water_use_today'].vector
    vector.x, vector.y, vector.z = litres
    view = TreeView(heard, zone, SimulatorParameters(), drinks=True)
    (line,) = [line for line in shown(view, 60.0, 80, 24) if 'drank' in line]
    told = line[line.index('drank') :].rstrip()
    assert [told.index(' L '), told.index(' to '), len(told)] == [12, 20, 29]
    known_by_nobody = TreeView(heard, zone, SimulatorParameters())
    assert 'drank' not in '\n'.join(shown(known_by_nobody, 60.0, 80, 24))


@pytest.mark.parametrize(('columns', 'rows'), SIZES)
def test_five_trees(zone, columns, rows):
    heard, names = Heard(), ('oak', 'ash', 'elm', 'fir', 'yew')
    view = TreesView(heard, zone, names)
    assert len(shown(view, 0.0, columns, rows)) <= rows - 2
    for i, name in enumerate(names):
        heard.hear_tree(f'{name}/', x=3.0 + 2.0 * i)
    after = shown(view, 30.0, columns, rows)
    assert len(after) <= rows - 2
    assert max(map(len, after)) <= columns
    text = '\n'.join(after)
    assert text.count('walking to (10.00,') == 5
    assert text.count('♣') == 5
    assert 'yew     11.00   5.50 m    0°' in text
    assert '-0' not in text


@pytest.mark.parametrize(('columns', 'rows'), SIZES)
def test_a_robot_that_drives(columns, rows):
    heard = Heard()
    view = DriveView(heard, {'odom': 'odom'}, 'state')
    before = shown(view, 0.0, columns, rows)
    heard.hear_tree()
    after = shown(view, 1.0, columns, rows)
    assert len(before) == len(after) == 4
    assert max(map(len, after)) <= columns
    assert 'odom     7.25   5.50 m    0°' in '\n'.join(after)
    assert '-0' not in '\n'.join(after)


def test_the_map_follows_the_terminal(zone):
    heard = Heard()
    heard.hear_tree()
    view = TreeView(heard, zone, SimulatorParameters())
    assert len(shown(view, 1.0, 200, 50)) > len(shown(view, 1.0, 80, 24))
    narrow = '\n'.join(shown(view, 1.0, 40, 16))
    assert 'walking to (10.00,' in narrow
    assert '♣' not in narrow  # no room for a map


def test_a_map_is_few_bytes_on_a_slow_line(zone):
    """Cells of one style go together: a style for each cell took six times the bytes."""
    console = Console(width=80, file=io.StringIO(), force_terminal=True, color_system='256')
    drawn = ZoneMap(zone, 48, 20)
    marks = {(3, 4): ('•', 'green'), (3, 5): ('•', 'green'), (9, 9): ('♣', 'bold green')}
    console.print(drawn.text(marks, lambda x, _: '░' if x > 8.0 else ' '))
    told = console.file.getvalue()
    assert len(told) < 2.5 * drawn.rows * drawn.columns
    assert Text.from_ansi(told).plain.rstrip('\n').count('░') > 100


TREES = ('oak', 'ash', 'elm', 'fir', 'yew')


@pytest.mark.parametrize('names', [(), TREES[:3], TREES[:4], TREES])
def test_what_a_tree_does_is_told_whole(zone, names):
    heard = Heard()
    for prefix in [f'{name}/' for name in names] or ['']:
        heard.hear_tree(prefix)
        state = 'walking to highest remembered sap flow 0.38 at (11.9, 11.9), felt 19 min ago'
        heard.messages[f'{prefix}state'] = String(data=state)
    view = TreesView(heard, zone, names) if names else TreeView(heard, zone, SimulatorParameters())
    text = '\n'.join(shown(view, 30.0, 80, 24))
    assert text.count('min ago') == max(len(names), 1)
    assert '…' not in text
