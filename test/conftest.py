"""Fixtures: a real ROS graph of this process, on its own domain."""

from __future__ import annotations

import asyncio
import atexit
import gc
import json
import os
import random
import signal
import socket
import struct
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from types import SimpleNamespace as Some

# looking for garbage after every 700 new objects takes up to half of what makes many that stay:
# imports, syntax trees, columns of messages
gc.set_threshold(50_000, 20, 20)

DOMAINS = range(1, 102)
"""0 is everyone's; the ports of those above 101 are among those that the system gives away"""


def free_domain():
    """Return a ROS domain of this process alone, and what keeps it until the process ends.

    A name in the abstract space of the system keeps other runs of these tests out: it is gone with
    its process, however that ends. Other graphs are seen by the port of their first participant.
    """
    for domain in random.sample(DOMAINS, len(DOMAINS)):
        lock = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        port = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        with port, suppress(OSError):
            lock.bind(f'\0agv_motion.test.domain.{domain}')
            port.bind(('127.0.0.1', 7400 + 250 * domain + 10))
            return domain, lock
        lock.close()
    msg = f'all ROS domains of {DOMAINS} are in use on this machine: end what uses them'
    raise RuntimeError(msg)


DOMAIN, LOCK = free_domain()
if signal.getsignal(signal.SIGHUP) is signal.SIG_IGN:
    # as nohup does: what the tests start would be deaf to it too; what is caught here is not
    signal.signal(signal.SIGHUP, lambda *_: None)
atexit.register(LOCK.close)
os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
os.environ['ROS_DOMAIN_ID'] = str(DOMAIN)
# shared memory left by a killed process can swallow messages of the next one on its port
os.environ['FASTDDS_BUILTIN_TRANSPORTS'] = 'UDPv4'
# what runs tests in parallel tells its workers the size of some terminal, into whose lines what the
# tests start would break what it writes into a pipe
for size in ('COLUMNS', 'LINES'):
    os.environ.pop(size, None)
# the matrices here are small: threads of BLAS cost more than they bring, the more on a busy machine
os.environ.setdefault('OPENBLAS_NUM_THREADS', '1')

import pytest
from hypothesis import HealthCheck, settings

settings.register_profile(
    'agv_motion',
    deadline=None,
    derandomize=True,
    max_examples=50,  # the same in each run: more of them cost time and find nothing new
    suppress_health_check=[HealthCheck.too_slow],  # a busy machine is no fault of a test
)
settings.load_profile('agv_motion')


LONG = (
    'test_robot', 'test_topic', 'test_tree', 'test_reprocess', 'test_pipeline', 'test_season',
    'test_graph_guard', 'test_trees', 'test_reservation_exchange', 'test_wheel_kinematics',
    'test_calibrate',
    'test_nodes_and_doctor', 'test_drive', 'test_freshness', 'test_driving', 'test_record',
    'test_kills', 'test_fusion', 'test_mutation', 'test_run_figure', 'test_stop',
    'test_calibration', 'test_shared_navigator', 'test_agent', 'test_independent_chain',
    'test_months', 'test_doors', 'test_traffic_search', 'test_recovery', 'test_crowd', 'test_house',
    'test_blocked', 'test_parameter_texts', 'test_fuzz', 'test_examples', 'test_animation',
)  # fmt: skip
"""Files that take longest: first, so that no worker is left alone with one at the end"""


ONE_WORKER = (
    ('test/dashboard/browser/',),
    ('test/cli/demo/', 'test/cli/recording/', 'test/reprocess/', 'test/dashboard/server/foxglove/'),
    ('test/cli/',),
)
"""Folders whose files share what takes seconds to make: a browser, a warm Python, recordings"""


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """Give each worker a file after the other, as loadfile does, or folders of `ONE_WORKER`."""
    if config.getoption('dist') != 'loadfile':
        return None
    from xdist.scheduler import LoadFileScheduling

    class Scheduling(LoadFileScheduling):
        def _split_scope(self, nodeid):
            file = super()._split_scope(nodeid)
            return next((folders[0] for folders in ONE_WORKER if file.startswith(folders)), file)

    return Scheduling(config, log)


def pytest_collection_modifyitems(items):
    """Put the longest files first; xdist does so with those of most tests, unless told not to."""
    order = {name: number for number, name in enumerate(LONG)}
    items.sort(key=lambda item: order.get(item.path.stem, len(LONG)))


def pytest_collection_finish():
    """Keep the collector from all that is imported: it is run before each graph, and often."""
    gc.freeze()


ENDS_TAKEN_IN = 10
"""Rounds in which the executor takes in new ends: what is said later is heard in that order"""


class Graph:
    """Nodes on the executor of live nodes, spun by the test itself: no threads, no sleeps."""

    def __init__(self, context):
        """Start with no node."""
        from rclpy.experimental import EventsExecutor

        self.context = context
        self.nodes = []
        self.mute = []
        """those that have no log"""
        self.executor = EventsExecutor(context=context)

    def node(self, name):
        """Return a node that only talks and listens: without services and log, at half the cost."""
        import rclpy

        without = rclpy.Parameter('start_type_description_service', value=False)
        node = rclpy.create_node(
            name,
            context=self.context,
            start_parameter_services=False,
            enable_rosout=False,
            parameter_overrides=[without],
        )
        self.mute.append(node)
        return self.add(node)

    def add(self, node):
        """Spin ``node`` with the others, and destroy it at the end of the test."""
        self.nodes.append(node)
        self.executor.add_node(node)
        return node

    def spin_until(self, condition, timeout=60.0):
        """Spin until ``condition()``; fail after ``timeout`` seconds."""
        end = time.monotonic() + timeout
        while not condition():
            assert time.monotonic() < end, 'timed out'
            self.executor.spin_once(timeout_sec=0.05)

    def repeat(self, act, until, every=0.1, timeout=60.0):
        """Call ``act()`` again and again, as a talker does, until ``until()``."""
        end = time.monotonic() + timeout
        while not until():
            assert time.monotonic() < end, 'timed out'
            act()
            again = time.monotonic() + every
            while (left := again - time.monotonic()) > 0.0 and not until():
                self.executor.spin_once(timeout_sec=min(left, 0.05))

    def quiet(self, inbox, seconds=0.3, timeout=60.0):
        """Spin until nothing has come into ``inbox`` for a while."""
        end = time.monotonic() + timeout
        while True:
            inbox.clear()
            self.spin_for(seconds)
            if not inbox:
                return
            assert time.monotonic() < end, 'never quiet'

    def meet(self):
        """Wait until all ends of topics on this graph know each other, logs included.

        What is said earlier is lost, and nobody says it again. What cannot meet (other types,
        other quality of service) is not waited for.
        """
        for _ in range(ENDS_TAKEN_IN):
            self.executor.spin_once(timeout_sec=0.0)
        self.spin_until(lambda: not self._strangers())

    def _strangers(self):
        """Return the ends that have not met all that they should."""
        from rclpy.qos import QoSCompatibility, qos_check_compatible

        speakers = [p for node in self.nodes for p in node.publishers]
        hearers = [s for node in self.nodes for s in node.subscriptions]

        def fit(speaker, hearer):
            return (
                speaker.topic_name == hearer.topic_name
                and speaker.msg_type is hearer.msg_type
                and qos_check_compatible(speaker.qos_profile, hearer.qos_profile)[0]
                is not QoSCompatibility.ERROR
            )

        # each node's publisher of /rosout is not among its publishers
        logs = len(self.nodes) - len(self.mute)
        return [
            speaker
            for speaker in speakers
            if speaker.get_subscription_count() < sum(fit(speaker, hearer) for hearer in hearers)
        ] + [
            hearer
            for hearer in hearers
            if hearer.get_publisher_count()
            < sum(fit(speaker, hearer) for speaker in speakers)
            + logs * (hearer.topic_name == '/rosout')
        ]

    def spin_for(self, seconds):
        """Spin for a while: the only way to see that nothing comes."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0.0:
            self.executor.spin_once(timeout_sec=min(left, 0.05))


@pytest.fixture
def apart(monkeypatch):
    """Be in a ROS domain of one's own: the robots of other tests may last for a session."""
    domain, lock = free_domain()
    monkeypatch.setenv('ROS_DOMAIN_ID', str(domain))
    yield
    lock.close()


@pytest.fixture(scope='session')
def wait_until():
    """Return what waits for something outside this process (a file, a thread): it has no event."""
    tick = threading.Event()

    def wait(condition, timeout=60.0):
        end = time.monotonic() + timeout
        while not condition():
            assert time.monotonic() < end, 'timed out'
            tick.wait(0.005)

    return wait


@pytest.fixture
def graph():
    """Return a fresh graph; everything in it is gone after the test."""
    rclpy = pytest.importorskip('rclpy')
    # the nodes of the last test: pytest held them until its very end, and one that the collector
    # finds later keeps the log of a new one of its name to itself
    gc.collect()
    gc.freeze()  # what outlives its test is not looked at again before the next one
    context = rclpy.Context()
    rclpy.init(context=context)
    graph = Graph(context)
    yield graph
    graph.executor.shutdown()
    for node in graph.nodes:
        node.destroy_node()
    rclpy.shutdown(context=context)


@pytest.fixture(scope='session')
def run_apart():
    """Return what runs a coroutine in a thread of its own: a browser may have a loop in ours."""

    def run(coroutine):
        with ThreadPoolExecutor(1) as pool:
            return pool.submit(asyncio.run, coroutine).result()

    return run


@pytest.fixture(scope='session')
def recorded(tmp_path_factory):
    """Return a folder of three recordings of a tree, the second of them spoilt."""
    pytest.importorskip('rclpy')
    from agv_motion.reprocess.simulated_tree import record_simulated_tree

    folder = tmp_path_factory.mktemp('recorded')
    record_simulated_tree(folder / 'a', 20)
    record_simulated_tree(folder / 'c', 30, seed=2)
    (folder / 'b').mkdir()
    (folder / 'b' / 'b_0.mcap').write_bytes(b'no bag')
    return folder


SPRUCE = 'granier_spruce_2012_2014.csv'


@pytest.fixture(scope='session')
def springs(spruce, tmp_path_factory):
    """Return a file with May and June of each year of the real recording: read in a sixth."""
    file = tmp_path_factory.mktemp('springs') / SPRUCE
    head, *rows = spruce.read_text(encoding='utf-8').splitlines(keepends=True)
    months = '-05-', '-06-'
    file.write_text(head + ''.join(row for row in rows if row[4:8] in months), encoding='utf-8')
    return file


@pytest.fixture(scope='session')
def spruce():
    """Return the path of the real recording, where it is beside the repository."""
    root = Path(__file__).resolve().parents[1]
    for folder in (os.environ.get('AGV_MOTION_DATA'), root.parent / 'shared' / 'data'):
        if folder and (Path(folder) / SPRUCE).exists():
            return Path(folder) / SPRUCE
    pytest.skip(f'{SPRUCE} is not here: set AGV_MOTION_DATA to its folder')
    return None


class DrivenRobot:
    """An ideal robot on the graph: each `cmd_vel` moves it by one step, and it tells its `odom`.

    As fast as the node under test commands; see `RealTimeRobot` for nodes that look at the clock.
    """

    def __init__(self, graph, step=0.1):
        """Stand at the origin and listen; `find` it when the node is there."""
        from geometry_msgs.msg import TwistStamped

        from agv_motion.planar import REST, Pose

        self.graph = graph
        self.node = graph.node('robot')
        self.pose = Pose(0.0, 0.0, 0.0)
        self.twist = REST
        self.commands = []
        self.silent = True
        self.stuck = False
        self._step = step
        self.node.create_subscription(TwistStamped, 'cmd_vel', self._on_command, 50)
        # who hears nothing commands nothing, and on a busy machine a pose may come too late
        self.node.create_timer(0.1, self._on_timer)

    def find(self):
        """Wait until the node listens, and say where the robot is."""
        from nav_msgs.msg import Odometry

        from agv_motion.ros.qos import SENSOR

        self.odometry = self.node.create_publisher(Odometry, 'odom', SENSOR)
        self.graph.spin_until(lambda: self.odometry.get_subscription_count() >= 1)
        self.graph.meet()
        self.silent = False
        self.report()

    def report(self, frame='odom'):
        """Tell where the robot is."""
        from nav_msgs.msg import Odometry

        from agv_motion.ros.messages import fill_pose

        message = Odometry()
        message.header.frame_id = frame
        message.header.stamp = self.node.get_clock().now().to_msg()
        fill_pose(message.pose.pose, self.pose)
        self.odometry.publish(message)

    def moves(self):
        """Wait for a command that is not zero."""
        self.commands.clear()
        self.graph.spin_until(lambda: any(map(any, self.commands)))

    def stands(self):
        """Wait for an explicit zero, and no other command after it."""
        self.commands.clear()
        self.graph.spin_until(lambda: self.commands and not any(self.commands[-1]))

    def _on_command(self, message):
        self._take(message)
        self._carry(self._step)
        if not self.silent:
            self.report()

    def _on_timer(self):
        if not self.silent:
            self.report()

    def _take(self, message):
        from agv_motion.planar import Twist

        twist = message.twist
        self.twist = Twist(twist.linear.x, twist.linear.y, twist.angular.z)
        self.commands.append(self.twist)

    def _carry(self, seconds):
        from agv_motion.planar import integrate

        if not self.stuck:
            self.pose = integrate(self.pose, self.twist, seconds)


class RealTimeRobot(DrivenRobot):
    """The same, but it moves as time passes; more slowly where the machine is too busy for it."""

    LONGEST_STEP = 0.1

    def __init__(self, graph):
        super().__init__(graph)
        self._last = time.monotonic()

    def find(self):
        super().find()
        self.node.create_timer(0.04, self._on_timer)

    def _on_command(self, message):
        self._pass()
        self._take(message)

    def _on_timer(self):
        self._pass()
        if not self.silent:
            self.report()

    def _pass(self):
        now = time.monotonic()
        self._carry(min(now - self._last, self.LONGEST_STEP))
        self._last = now


@pytest.fixture
def driven_robot(graph):
    """Return what makes a robot that moves with each command."""
    return lambda **options: DrivenRobot(graph, **options)


@pytest.fixture
def real_time_robot(graph):
    """Return what makes a robot that moves as time passes."""
    return lambda: RealTimeRobot(graph)


class FoxgloveTool:
    """A client of the endpoint `/foxglove`, by hand and the library websockets."""

    def __init__(self, server, subprotocol='foxglove.sdk.v1', path='/foxglove', **options):
        url = server.url.replace('http', 'ws', 1) + path
        names = options.pop('subprotocols', [subprotocol])
        from websockets.sync.client import connect

        self.context = connect(
            url,
            subprotocols=names,
            max_size=None,
            compression=None,
            close_timeout=1,
            open_timeout=60.0,
            **options,
        )
        self.socket = self.context.__enter__()
        self.kept = []
        self.info = self.wait('serverInfo')

    def ask(self, op, **told):
        self.socket.send(json.dumps({'op': op} | told))

    def wait(self, op, fits=lambda _: True):
        """Return the next message of a kind; others are kept for later."""
        for told in self.kept:
            if told['op'] == op and fits(told):
                self.kept.remove(told)
                return told
        while True:
            told = decoded(self.socket.recv(timeout=60.0))
            if told['op'] == op and fits(told):
                return told
            self.kept.append(told)

    def refusal(self):
        return self.wait('status', lambda told: told['level'] == 2)['message']

    def channels(self, *topics):
        """Return the number of each channel, when all are advertised."""
        found = {}
        while not set(topics) <= found.keys():
            found |= {one['topic']: one for one in self.wait('advertise')['channels']}
        return [found[topic]['id'] for topic in topics]

    def subscribe(self, *topics):
        """Subscribe to topics, each by the number of its place from 0."""
        rows = [{'id': n, 'channelId': c} for n, c in enumerate(self.channels(*topics))]
        self.ask('subscribe', subscriptions=rows)

    def data(self):
        told = self.wait('message')
        return told['id'], told['data']

    def closed(self):
        """Return code and reason, when the server has closed.

        1006 is of who was still sending: the reset of his connection overtook the reason.
        """
        with suppress(Exception):
            while True:
                self.socket.recv(timeout=60.0)
        return Some(code=self.socket.close_code, reason=self.socket.close_reason)


def decoded(message):
    if isinstance(message, str):
        return json.loads(message)
    kinds = {1: 'message', 2: 'time', 3: 'response', 4: 'asset', 5: 'playback'}
    if message[0] == 1:
        number, stamp = struct.unpack_from('<IQ', message, 1)
        return {'op': 'message', 'id': number, 'stamp': stamp, 'data': message[13:]}
    return {'op': kinds[message[0]], 'bytes': message[1:]}


@pytest.fixture
def connect():
    """Return what makes clients of the endpoint `/foxglove` of a server with an ``url``."""
    opened = []

    def make(*args, **options):
        made = FoxgloveTool(*args, **options)
        opened.append(made)
        return made

    yield make
    for one in opened:
        one.context.__exit__(None, None, None)
