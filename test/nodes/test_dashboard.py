"""The node behind the page, on a real graph: robots found, STOP that is seen to work, a hand."""

from __future__ import annotations

import asyncio
import itertools
import json
import threading
import urllib.request

import pytest

pytest.importorskip('rclpy')
websockets = pytest.importorskip('websockets.asyncio.client')
pytest.importorskip('starlette')

from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import PoseStamped, TwistStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, Float64, String
from std_srvs.srv import SetBool

from agv_motion.nodes.arbiter import ArbiterNode
from agv_motion.nodes.dashboard import Dashboard
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.run import overrides, start


class Page:
    """The page of a node, and one browser on it, in a thread: the test spins the graph."""

    def __init__(self, graph, node):
        self.graph, self.node = graph, node
        self.url = node.plain.server.url
        self.loop = asyncio.new_event_loop()
        self.thread = threading.Thread(target=self.loop.run_forever, daemon=True)
        self.thread.start()
        self.slots, self.outcomes, self.hello = {}, [], {}
        self.looking = self.run(self._look())
        graph.spin_until(lambda: self.hello)

    def run(self, coroutine):
        return asyncio.run_coroutine_threadsafe(coroutine, self.loop)

    async def _look(self):
        async with websockets.connect(self.url.replace('http', 'ws') + '/live') as live:
            async for text in live:
                told = json.loads(text)
                if told['kind'] == 'hello':
                    self.hello = told
                elif told['kind'] == 'outcome':
                    self.outcomes.append(told)
                else:
                    for one in told['updates']:
                        self.slots[one['robot'], one['topic']] = one['value']
                    await live.send(json.dumps({'ack': told['n']}))

    def post(self, path, **told):
        """Act as the page does; the graph is spun until the answer is there."""
        headers = {
            'X-CSRF-Token': self.hello['csrf'], 'Idempotency-Key': f'key-{len(self.outcomes):08}',
            'Content-Type': 'application/json', 'Origin': self.url,
        }  # fmt: skip
        request = urllib.request.Request(  # noqa: S310 - ours
            self.url + path, json.dumps(told).encode(), headers
        )

        def ask():
            with urllib.request.urlopen(request) as answer:  # noqa: S310 - ours
                return json.load(answer)['id']

        future = self.run(asyncio.to_thread(ask))
        self.graph.spin_until(future.done)
        return future.result()

    def ended(self, number):
        """Return the outcome of an act, when it has one."""

        def found():
            return [o for o in self.outcomes if o['id'] == number and o['state'] != 'sent']

        self.graph.spin_until(found)
        return found()[0]

    def sees(self, robot, topic, condition):
        self.graph.spin_until(
            lambda: (robot, topic) in self.slots and condition(self.slots[robot, topic])
        )

    async def _end(self):
        """End all that runs here: what is only cancelled may still be under way."""
        others = asyncio.all_tasks() - {asyncio.current_task()}
        for task in others:
            task.cancel()
        await asyncio.gather(*others, return_exceptions=True)
        await self.loop.shutdown_default_executor()

    def close(self):
        stopped = self.run(self._end())
        self.graph.spin_until(stopped.done)
        self.loop.call_soon_threadsafe(self.loop.stop)
        self.thread.join(10.0)
        self.loop.close()


@pytest.fixture
def open_page(graph, tmp_path):
    """Return what opens the page on the graph of the test."""
    opened = []

    def make(**parameters):
        values = {'port': 0, 'state_folder': str(tmp_path / 'state')} | parameters
        node = graph.add(
            LiveNode(Dashboard, context=graph.context, parameter_overrides=overrides(**values))
        )
        start(node)
        opened.append((Page(graph, node), node))
        return opened[-1][0]

    yield make
    for page, node in opened:
        page.close()
        node.trigger_deactivate()


class Oak:
    """A robot with an arbiter, whose wheels turn as fast as it is commanded."""

    def __init__(self, tester, graph):
        self.graph = graph
        self.arbiter = graph.add(LiveNode(ArbiterNode, context=graph.context, namespace='oak'))
        start(self.arbiter)
        node = tester.node
        self.speed = 0.0
        self.commands = []
        self.state = node.create_publisher(JointState, '/oak/turrets/state', 5)
        self.agent = node.create_publisher(TwistStamped, '/oak/cmd_vel/agent', 1)
        node.create_subscription(TwistStamped, '/oak/cmd_vel', self._on_command, 10)
        node.create_timer(0.05, self._tell)
        self.walks = True

    def _on_command(self, message):
        self.speed = message.twist.linear.x
        self.commands.append(self.speed)

    def _tell(self):
        names = [f'turret_{i}_{what}' for what in ('steering', 'wheel') for i in range(3)]
        self.state.publish(JointState(
            name=names, position=[0.0] * 6, velocity=[0.0] * 3 + [self.speed] * 3))  # fmt: skip
        if self.walks:
            twist = TwistStamped()
            twist.twist.linear.x = 1.0
            twist.header.stamp = self.arbiter.get_clock().now().to_msg()
            self.agent.publish(twist)


@pytest.fixture
def oak(tester, graph):
    return Oak(tester, graph)


def test_stop_is_done_when_the_wheels_stand_and_holds_until_released(oak, open_page):
    page = open_page()
    page.sees('oak', 'summary', lambda summary: summary['moving'])
    outcome = page.ended(page.post('/robots/oak/stop'))
    assert outcome['state'] == 'done', outcome
    assert oak.speed == 0.0
    page.sees('oak', 'summary', lambda s: s['stopped'] and s['standstill'] and s['colour'] == 'red')
    assert oak.commands[-1] == 0.0
    assert page.ended(page.post('/robots/oak/release'))['state'] == 'done'
    page.sees('oak', 'summary', lambda summary: summary['moving'] and not summary['stopped'])


def test_a_hand_drives_and_who_lets_go_stops_the_wheels(oak, open_page, graph):
    oak.walks = False
    page = open_page()
    page.sees('oak', 'driver', lambda driver: driver['driver'] == '')
    page.graph.spin_until(lambda: page.node.count_subscribers('/oak/cmd_vel/manual') == 1)

    driven = threading.Event()  # until then the hand goes on, however long that takes

    async def drive():
        url = page.url.replace('http', 'ws') + '/robots/oak/drive'
        async with websockets.connect(url) as hand:
            await hand.send(json.dumps({'csrf': page.hello['csrf']}))
            for count in itertools.count():
                told = {'n': count, 't': 50.0 * count, 'vx': 0.5, 'vy': 0.0, 'wz': 0.0}
                await hand.send(json.dumps(told))
                if await asyncio.to_thread(driven.wait, 0.05):
                    break
            hand.transport.abort()  # the network is gone

    driving = page.run(drive())
    graph.spin_until(lambda: oak.speed == 0.5)
    driven.set()
    graph.spin_until(driving.done)
    graph.spin_until(lambda: oak.speed == 0.0)
    page.sees('oak', 'driver', lambda driver: driver['lost'] == 'manual')
    page.sees('oak', 'summary', lambda summary: summary['word'] == 'stopped')


def test_without_an_arbiter_stop_is_a_service_of_the_kinematics(tester, graph, open_page):
    asked = []

    def on_stop(request, response):
        asked.append(request.data)
        response.success, response.message = True, 'stopped'
        return response

    node = tester.node
    node.create_service(SetBool, '/elm/wheel_kinematics/stop', on_stop)
    state = node.create_publisher(JointState, '/elm/turrets/state', 5)
    message = JointState(name=['turret_0_steering', 'turret_0_wheel'], position=[0.0, 0.0],
                         velocity=[0.0, 0.0])  # fmt: skip
    node.create_timer(0.05, lambda: state.publish(message))
    page = open_page()
    page.sees('elm', 'turrets', lambda _: True)
    assert page.ended(page.post('/robots/elm/stop'))['state'] == 'done'
    assert asked == [True]


def test_a_robot_that_nobody_can_stop_says_so(tester, open_page):
    state = tester.node.create_publisher(JointState, '/elm/wheels/state', 5)
    tester.node.create_timer(0.05, lambda: state.publish(JointState(name=['a', 'b'])))
    page = open_page()
    page.sees('elm', 'wheels', lambda _: True)
    outcome = page.ended(page.post('/robots/elm/stop'))
    assert outcome['state'] == 'refused'
    assert 'nobody there can stop' in outcome['text']


def test_numbers_that_are_none_and_topics_of_other_types_harm_nothing(tester, open_page):
    node = tester.node
    nan = float('nan')
    state = node.create_publisher(JointState, '/elm/turrets/state', 5)
    message = JointState(name=['turret_0_steering', 'turret_0_wheel'], position=[nan, 0.0],
                         velocity=[0.0, nan])  # fmt: skip
    wrong = node.create_publisher(Float64, '/elm/pose', 5)
    node.create_timer(0.05, lambda: (state.publish(message), wrong.publish(Float64(data=nan))))
    page = open_page()
    page.sees('elm', 'turrets', lambda turrets: turrets['angles'] == [None])
    assert ('elm', 'pose') not in page.slots


def test_a_robot_that_vanishes_is_shown_as_silent_and_not_forgotten(tester, graph, open_page):
    state = tester.node.create_publisher(JointState, '/elm/wheels/state', 5)
    said = tester.node.create_timer(0.05, lambda: state.publish(JointState(name=['a', 'b'])))
    page = open_page()
    page.sees('elm', 'summary', lambda summary: summary['word'] != 'silent')
    said.cancel()
    page.sees('elm', 'summary', lambda s: s['word'] == 'silent' and s['colour'] == 'red')


def test_a_goal_and_a_mark_reach_the_graph(tester, graph, open_page):
    node = tester.node
    goals, marks, latched = [], [], []
    node.create_subscription(PoseStamped, '/elm/goal_pose', goals.append, 1)
    node.create_subscription(String, '/mark', marks.append, 10)
    driver = node.create_publisher(DiagnosticStatus, '/elm/driver', 5)
    node.create_timer(0.05, lambda: driver.publish(DiagnosticStatus()))
    node.create_subscription(Bool, '/elm/standstill', latched.append, 1)
    page = open_page()
    page.sees('elm', 'driver', lambda _: True)
    graph.spin_until(lambda: node.count_publishers('/elm/goal_pose') == 1)
    graph.meet()
    page.post('/robots/elm/goal', x=1.0, y=2.0)
    graph.spin_until(lambda: goals)
    assert (goals[0].pose.position.x, goals[0].pose.position.y) == (1.0, 2.0)
    page.post('/mark', text='here')
    graph.spin_until(lambda: marks)
    assert marks[0].data == 'here'
