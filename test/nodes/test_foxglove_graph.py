"""The endpoint `/foxglove` on a real graph: what is said comes through, and what is asked is done.

What comes is decoded by `rosbags` from the definitions that the endpoint tells, and by nothing of
ours.
"""

from __future__ import annotations

import struct
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace as Some

import pytest

rclpy = pytest.importorskip('rclpy')
pytest.importorskip('websockets')
pytest.importorskip('starlette')

from geometry_msgs.msg import PoseStamped, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message, serialize_message
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from std_msgs.msg import String
from std_srvs.srv import SetBool

from agv_motion.nodes.arbiter import ArbiterNode
from agv_motion.nodes.dashboard import Dashboard
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.qos import COMMAND, LATCHED
from agv_motion.ros.run import overrides, start

LOSSY = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)


@pytest.fixture
def during(graph):
    """Return what runs a function beside the graph, which is spun until it has returned.

    Meanwhile ``say()`` is called again and again.
    """
    with ThreadPoolExecutor(1) as pool:

        def run(act, *args, say=lambda: None, **options):
            future = pool.submit(act, *args, **options)
            graph.repeat(say, future.done)
            return future.result()

        yield run


@pytest.fixture
def serve(graph, tmp_path):
    """Return what opens the endpoint on the graph of the test."""
    nodes = []

    def make(**parameters):
        values = {'port': 0, 'state_folder': str(tmp_path / 'state'), 'page': False} | parameters
        node = graph.add(
            LiveNode(Dashboard, context=graph.context, parameter_overrides=overrides(**values))
        )
        start(node)
        nodes.append(node)
        return Some(url=node.plain.server.url)

    yield make
    for node in nodes:
        node.trigger_deactivate()


@pytest.fixture
def tool(serve, connect, during):
    made = during(connect, serve(foxglove_acts=True))
    made.during = during
    return made


def decoder(channel):
    """Return what decodes messages of a channel, from its definition alone."""
    store = get_typestore(Stores.EMPTY)
    kind = channel['schemaName']
    store.register(get_types_from_msg(channel['schema'], kind))
    return lambda data: store.deserialize_cdr(data, kind)


def channel(tool, topic):
    """Return what is told of a topic, when it is."""
    told = tool.wait('advertise', lambda t: any(c['topic'] == topic for c in t['channels']))
    tool.kept.append(told)
    return next(c for c in told['channels'] if c['topic'] == topic)


def subscribe(tool, topic, number):
    found = channel(tool, topic)
    tool.ask('subscribe', subscriptions=[{'id': number, 'channelId': found['id']}])
    return decoder(found)


def heard(tool, number):
    return tool.wait('message', lambda told: told['id'] == number)['data']


def test_each_message_comes_as_its_bytes_on_any_terms(tester, tool, during):
    """Publishers that latch and such that do not, reliable and not, share topics."""
    latched = tester.node.create_publisher(String, '/shared', LATCHED)
    latched.publish(String(data='of old'))
    volatile = tester.node.create_publisher(String, '/shared', LOSSY)
    odom = tester.node.create_publisher(Odometry, '/oak/odom', LOSSY)
    decode = during(subscribe, tool, '/shared', 1)
    assert decode(during(heard, tool, 1)).data == 'of old'
    tester.graph.repeat(
        lambda: volatile.publish(String(data='of now')),
        lambda: volatile.get_subscription_count() >= 1,
    )
    decode_odom = during(subscribe, tool, '/oak/odom', 2)
    tester.graph.spin_until(odom.get_subscription_count)
    tester.graph.meet()
    said = Odometry()
    said.header.frame_id, said.child_frame_id = 'odom', 'base_link'
    said.header.stamp.sec, said.twist.twist.linear.x = 7, -0.125
    said.pose.covariance[35] = 3.5
    data = during(heard, tool, 2, say=lambda: odom.publish(said))
    assert serialize_message(deserialize_message(data, Odometry)) == serialize_message(said)
    found = decode_odom(data)
    assert (found.header.frame_id, found.header.stamp.sec) == ('odom', 7)
    assert (found.twist.twist.linear.x, found.pose.covariance[35]) == (-0.125, 3.5)
    last, texts = String(data='last'), ['']
    while texts[-1] != 'last':
        heard_now = during(heard, tool, 1, say=lambda: volatile.publish(last))
        texts.append(decode(heard_now).data)
    assert 'of old' not in texts


def test_three_who_latch_on_one_topic_are_all_heard_also_by_who_is_late(
    tester, tool, serve, connect, during
):
    speakers = [tester.node.create_publisher(String, '/parts', LATCHED) for _ in range(3)]
    for number, one in enumerate(speakers):
        one.publish(String(data=str(number)))
    for client in (tool, during(connect, serve(foxglove_acts=False))):
        decode = during(subscribe, client, '/parts', 1)
        assert {decode(during(heard, client, 1)).data for _ in range(3)} == {'0', '1', '2'}


def test_what_is_asked_is_done_and_nothing_passes_the_arbiter(graph, tester, tool, during):
    arbiter = graph.add(LiveNode(ArbiterNode, context=graph.context, namespace='oak'))
    start(arbiter)
    commands = tester.listen(TwistStamped, '/oak/cmd_vel')
    goals = tester.listen(PoseStamped, '/oak/goal_pose')

    def advertise(number, topic, kind):
        row = {'id': number, 'topic': topic, 'encoding': 'cdr', 'schemaName': kind}
        tool.ask('advertise', channels=[row])

    def publish(number, message):
        tool.socket.send(struct.pack('<BI', 1, number) + serialize_message(message))

    def call(data):
        told = tool.wait('advertiseServices', lambda t: '/oak/arbiter/stop' in str(t))
        tool.kept.append(told)
        (stop,) = (s for s in told['services'] if s['name'] == '/oak/arbiter/stop')
        request = serialize_message(SetBool.Request(data=data))
        tool.socket.send(struct.pack('<BIII', 2, stop['id'], 9, 3) + b'cdr' + request)
        answer = tool.wait('response')['bytes'][15:]
        return deserialize_message(answer, SetBool.Response)

    advertise(1, '/oak/cmd_vel/manual', 'geometry_msgs/msg/TwistStamped')
    advertise(2, '/oak/goal_pose', 'geometry_msgs/msg/PoseStamped')
    advertise(3, '/ash/cmd_vel/manual', 'geometry_msgs/msg/TwistStamped')
    twist, goal = TwistStamped(), PoseStamped()
    goal.pose.position.x = 2.5
    publish(2, goal)
    assert tester.wait(goals).pose.position.x == 2.5
    publish(3, twist)
    assert 'nobody listens' in during(tool.refusal)
    goal.pose.position.y = float('nan')
    publish(2, goal)
    assert 'pose.position.y = nan: must be a finite number' in during(tool.refusal)
    tool.socket.send(struct.pack('<BI', 1, 2) + b'\0\1\0\0abc')
    assert 'PoseStamped' in during(tool.refusal)

    assert during(call, data=True).success

    frame = tester.wait(commands).header.frame_id

    def drive():
        twist.header.frame_id = frame
        twist.header.stamp = tester.node.get_clock().now().to_msg()
        twist.twist.linear.x = 0.1
        publish(1, twist)

    del commands[:]
    tester.graph.repeat(drive, lambda: len(commands) > 10)
    assert {c.twist.linear.x for c in commands} == {0.0}
    assert during(call, data=False).success
    tester.graph.repeat(drive, lambda: any(c.twist.linear.x > 0.0 for c in commands))


def test_connections_and_parameters_are_told(graph, tester, tool, during):
    tester.node.create_publisher(String, '/said', COMMAND)
    tester.listen(String, '/said')
    arbiter = graph.add(LiveNode(ArbiterNode, context=graph.context, namespace='oak'))
    start(arbiter)
    tool.ask('subscribeConnectionGraph')

    def told():
        topics = {}
        while '/said' not in topics:
            update = tool.wait('connectionGraphUpdate')
            topics = {row['name']: row['publisherIds'] for row in update['publishedTopics']}
        return update

    update = during(told)
    assert {'name': '/said', 'publisherIds': ['/tester']} in update['publishedTopics']
    assert {'name': '/said', 'subscriberIds': ['/tester']} in update['subscribedTopics']
    shown = {row['name'] for row in update['publishedTopics']}
    assert '/oak/driver' in shown
    assert '/oak/arbiter/stop/_service_event' not in shown  # hidden, as for the tools of ROS

    def wait_for_rate(value):
        while True:
            found = tool.wait('parameterValues')['parameters']
            if {row['name']: row.get('value') for row in found}.get('/oak/arbiter.rate') == value:
                return

    tool.ask('subscribeParameterUpdates', parameterNames=[])

    def read():
        tool.ask('getParameters', parameterNames=['/oak/arbiter.rate'], id='r')
        return tool.wait('parameterValues', lambda t: t.get('id') == 'r')['parameters']

    tester.graph.spin_until(lambda: during(read))
    (row,) = during(read)
    tool.ask(
        'setParameters', id='s', parameters=[{'name': row['name'], 'value': row['value'] + 1.0}]
    )
    answer = during(tool.wait, 'parameterValues', lambda t: t.get('id') == 's')
    refused = [t['message'] for t in tool.kept if t['op'] == 'status']
    changed = answer['parameters'][0]['value'] == row['value'] + 1.0
    assert changed or 'rate' in ' '.join(refused)
