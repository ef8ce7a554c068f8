"""Somebody's node over a recording: what it says, twice the same, and what is refused by name."""

from __future__ import annotations

import struct
import sys
from contextlib import closing

import pytest

pytest.importorskip('rclpy')

from agv_motion.bag import BagReader, BagWriter
from agv_motion.reprocess import Plan
from agv_motion.ros.many_bags import outcomes

SECOND = 10**9
START = 1_700_000_000

TRACKER = """
import random
import time

from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Float64, Int32, String

SEEN = []


class Tracker(Node):
    def __init__(self):
        super().__init__('tracker')
        self.declare_parameter('gain', 1.0)
        self.add_on_set_parameters_callback(lambda _: None)
        self.total = 0
        self.begun = self.get_clock().now()
        self.sum = self.create_publisher(Float64, 'sum', 10)
        self.text = self.create_publisher(
            String, '~/text', QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT))
        self.create_subscription(Int32, 'n', self.on_number, 10)
        self.create_subscription(Float64, '/robot/sum', self.on_sum, 10)
        self.timer = self.create_timer(0.5, self.on_timer)
        self.once = self.create_timer(1.2, self.on_once)
        self.heard = []

    def on_number(self, message):
        SEEN.append(message.data)
        self.total += message.data
        self.sum.publish(Float64(data=self.get_parameter('gain').value * self.total))

    def on_sum(self, message):
        self.heard.append(message.data)

    def on_once(self):
        self.once.cancel()
        self.text.publish(String(data=f'once {self.timer.timer_period_ns}'))
        self.timer.timer_period_ns = 10**9

    def on_timer(self):
        now = self.get_clock().now()
        words = ' '.join({'oak', 'elm', 'ash', 'yew'})
        draw = random.random()
        self.text.publish(String(
            data=f'{(now - self.begun).nanoseconds} {len(SEEN)} {draw} {words}'))
"""

REFUSED = {
    'service': ("self.create_service(Trigger, 's', lambda a, b: b)", 'offers a service'),
    'client': ("self.create_client(Trigger, 's')", 'has a client of a service'),
    'action': ("ActionClient(self, LookupTransform, 'a')", 'has a client of an action'),
    'thread': ('threading.Thread(target=print).start()', 'starts a thread'),
    'pool': ('ThreadPoolExecutor(1).submit(print)', 'starts a thread'),
    'process': ("__import__('subprocess').run(['true'])", 'starts a process, subprocess.run()'),
    'system': ("__import__('os').system('true')", 'starts a process, os.system()'),
    'socket': ("__import__('socket').socket()", 'opens a socket'),
    'entropy': ("__import__('os').urandom(8)", 'makes what is never the same, os.urandom()'),
    'wall': ('time.time()', 'looks at the clock on the wall, time.time()'),
    'swallowed': ('self.swallow()', 'looks at the clock on the wall, time.monotonic()'),
    'date': ('self.stamp = datetime.now()', 'asks for datetime.now() in user_date.py, line 16'),
    'clock': ('Clock(clock_type=ClockType.STEADY_TIME).now()', 'looks at a clock of its own'),
    'sleep': ('time.sleep(1)', 'sleeps, time.sleep()'),
    'spin': ('rclpy.spin_once(self)', 'spins in user_spin.py, line 16'),
    'graph': ('self.get_topic_names_and_types()', 'looks at the graph'),
    'rate': ('self.create_rate(10)', 'sleeps by a rate'),
    'seed': ('np.random.default_rng()', 'draws random numbers without a seed'),
    'timer': ('self.create_timer(0.1, self.late)', 'looks at the clock on the wall, time.time()'),
    'async': ('self.create_timer(0.1, self.soon)', 'has an asynchronous callback'),
}
USER = """
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from datetime import datetime

import numpy as np
import rclpy
from rclpy.action import ActionClient
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from std_srvs.srv import Trigger

LookupTransform = None
class User(Node):
    def __init__(self): super().__init__('user'); {line}
    def late(self): time.time()
    async def soon(self): pass
    def swallow(self):
        try:
            time.monotonic()
        except Exception:
            pass


class Other(Node):
    def __init__(self, name):
        super().__init__(name)


class Lazy(Node):
    def __init__(self):
        pass


class Broken(Node):
    def __init__(self):
        super().__init__('broken')
        self.create_timer(0.1, self.fail)

    def fail(self):
        return 1 / 0
"""


def number(value):
    return struct.pack('<4si', b'\0\1\0\0', value)


@pytest.fixture(scope='module')
def place(tmp_path_factory):
    """Return a folder with a bag of numbers, and modules of nodes that can be imported."""
    folder = tmp_path_factory.mktemp('foreign')
    with BagWriter(folder / 'bag') as bag:
        topic = bag.add_topic('/robot/n', 'std_msgs/msg/Int32')
        for i in range(8):
            bag.write(topic, START * SECOND + i * SECOND // 2, number(i))
    (folder / 'my_robot').mkdir()
    (folder / 'my_robot' / '__init__.py').touch()
    (folder / 'my_robot' / 'tracker.py').write_text(TRACKER)
    for name, (line, _) in REFUSED.items():
        (folder / f'user_{name}.py').write_text(USER.format(line=line))
    (folder / 'tracker.yaml').write_text('/robot/tracker: {ros__parameters: {gain: 0.5}}\n')
    sys.path.append(str(folder))
    yield folder
    sys.path.remove(str(folder))


def run(place, target, out, config='', namespace='/'):
    plan = Plan(config, (), (), 'zstd', namespace, (target,))
    with closing(outcomes([(place / 'bag', out)], plan, 1, '')) as coming:
        return next(coming)


def told(bag, topic):
    with BagReader(bag) as reader:
        return [(m.stamp, m.data) for m in reader.messages([topic])]


def test_a_node_says_the_same_twice_and_what_it_should(place, tmp_path):
    for name in ('one', 'two'):
        outcome = run(
            place, 'my_robot.tracker:Tracker', tmp_path / name / 'out',
            str(place / 'tracker.yaml'), '/robot',
        )  # fmt: skip
        assert outcome.failure == ''
        assert (outcome.messages_in, outcome.missing) == (8, ())
    files = [(tmp_path / n / 'out' / 'out_0.mcap').read_bytes() for n in ('one', 'two')]
    assert files[0] == files[1]
    sums = told(tmp_path / 'one' / 'out', '/robot/sum')
    assert [struct.unpack('<d', data[4:])[0] for _, data in sums] == [
        0.5 * i * (i + 1) / 2 for i in range(8)
    ]
    assert [stamp - START * SECOND for stamp, _ in sums] == [i * SECOND // 2 for i in range(8)]
    words = [
        data[8:-1].decode() for _, data in told(tmp_path / 'one' / 'out', '/robot/tracker/text')
    ]
    # a timer that is due with a message comes first; from 1.2 s on, once a second
    assert [word.split()[:2] for word in words] == [
        ['500000000', '1'], ['1000000000', '2'], ['once', '500000000'], ['2200000000', '5'],
        ['3200000000', '7'],
    ]  # fmt: skip


def test_a_result_is_made_anew_where_the_node_has_changed(place, tmp_path):
    target, out = 'user_wall:Broken', tmp_path / 'out'
    failed = run(place, target, out)
    assert 'broken failed at' in failed.failure
    assert 'ZeroDivisionError: division by zero' in failed.failure
    assert 'user_wall.py, line' in failed.failure
    text = (place / 'user_wall.py').read_text()
    (place / 'user_wall.py').write_text(text.replace('return 1 / 0', 'return 1'))
    assert run(place, target, out).failure == ''
    assert run(place, target, out).made_before
    (place / 'user_wall.py').write_text(text)
    assert 'exists' in run(place, target, out).failure


@pytest.mark.parametrize('name', REFUSED)
def test_what_would_not_be_the_same_again_is_refused_by_name(place, tmp_path, name):
    outcome = run(place, f'user_{name}:User', tmp_path / 'out')
    assert f'user_{name}:User cannot be reprocessed: it ' in outcome.failure
    assert REFUSED[name][1] in outcome.failure
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(('target', 'words'), [
    ('user_wall', 'give package.module:Class'), ('user_wall:Use', "did you mean 'User'"),
    ('nowhere.at:All', 'is not installed'), ('my_robot.gone:Node', 'cannot be imported'),
    ('user_wall:Other', 'cannot be made without arguments'),
    ('user_wall:Lazy', 'did not call super().__init__'),
])  # fmt: skip
def test_what_is_no_node_is_told(place, tmp_path, target, words):
    assert words in run(place, target, tmp_path / 'out').failure
