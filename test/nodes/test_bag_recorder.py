"""The recorder on a real graph: every publisher is heard, whatever it offers."""

from __future__ import annotations

import pytest
from rosbags.rosbag2 import Reader

rclpy = pytest.importorskip('rclpy')

from builtin_interfaces.msg import Time
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from rclpy.qos import QoSProfile
from rclpy.serialization import deserialize_message
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Int32, String
from std_srvs.srv import SetBool, Trigger

from agv_motion.bag.columns.columns import read_topic
from agv_motion.bag.reader import BagReader
from agv_motion.bag.recording import recorded_transforms
from agv_motion.nodes import bag_recorder
from agv_motion.nodes.bag_recorder import BagRecorder
from agv_motion.ros.run import StartError

RELIABLE = QoSProfile(depth=1000)


@pytest.fixture
def record(tester, tmp_path):
    """Return a function that starts a recorder of all topics with Int32."""

    def start(**parameters):
        given = {'output': str(tmp_path / 'bag'), 'regex': '^/n', 'storage__keep_free': 0.0}
        return tester.start(BagRecorder, **{**given, **parameters})

    return start


def read(path):
    """Return the numbers of each topic."""
    found = {}
    with Reader(path) as reader:
        for connection, _, data in reader.messages():
            found.setdefault(connection.topic, []).append(deserialize_message(data, Int32).data)
    return found


def numbered(tester, topic, qos=RELIABLE):
    """Return a publisher of Int32 without waiting for its listener."""
    return tester.node.create_publisher(Int32, topic, qos)


def send(publisher, *numbers):
    for number in numbers:
        publisher.publish(Int32(data=number))


def recorded(tester, node, count):
    """Spin until the recorder has taken ``count`` messages."""
    tester.graph.spin_until(lambda: node.plain.recording.messages >= count)


def heard(tester, *publishers):
    tester.graph.spin_until(lambda: all(p.get_subscription_count() for p in publishers))


def test_all_messages_of_all_topics_those_that_come_later_too(tester, record, tmp_path):
    first = numbered(tester, 'n1')
    node = record()
    heard(tester, first)
    send(first, *range(100))
    recorded(tester, node, 100)
    later = numbered(tester, 'n2')
    heard(tester, later)
    send(later, *range(50))
    recorded(tester, node, 150)
    node.trigger_deactivate()
    assert read(tmp_path / 'bag') == {'/n1': list(range(100)), '/n2': list(range(50))}
    assert {t.name: (t.messages, t.lost) for t in node.plain.report} == {
        '/n1': (100, 0),
        '/n2': (50, 0),
    }


def test_latched_messages_from_before_are_recorded(tester, record, tmp_path, qos):
    send(numbered(tester, 'n', qos['latched']), 7, 8)
    node = record()
    recorded(tester, node, 1)
    node.trigger_deactivate()
    assert read(tmp_path / 'bag') == {'/n': [8]}
    with Reader(tmp_path / 'bag') as reader:
        (profile,) = reader.connections[0].ext.offered_qos_profiles
    assert (profile.reliability.name, profile.durability.name) == ('RELIABLE', 'TRANSIENT_LOCAL')


def test_publishers_that_offer_different_things_are_all_heard_once(tester, record, tmp_path, qos):
    latched = numbered(tester, 'n', qos['latched'])
    send(latched, 1)
    node = record()
    recorded(tester, node, 1)
    weak = numbered(tester, 'n', QoSProfile(depth=100, reliability=qos['sensor'].reliability))
    heard(tester, weak)
    tester.graph.spin_until(lambda: latched.get_subscription_count() == 2)
    send(weak, 2)
    recorded(tester, node, 2)
    send(latched, 3)
    recorded(tester, node, 3)
    tester.graph.spin_for(0.3)
    node.trigger_deactivate()
    assert read(tmp_path / 'bag') == {'/n': [1, 2, 3]}


def test_a_pause_is_left_out_and_not_called_a_loss(tester, record, tmp_path):
    publisher = numbered(tester, 'n')
    node = record()
    heard(tester, publisher)
    send(publisher, 1)
    recorded(tester, node, 1)
    assert tester.ask(Trigger, 'bag_recorder/pause', Trigger.Request()).success
    send(publisher, 2)
    assert publisher.wait_for_all_acked()
    tester.graph.spin_for(0.2)
    assert tester.ask(Trigger, 'bag_recorder/toggle_paused', Trigger.Request()).success
    send(publisher, 3)
    recorded(tester, node, 2)
    node.trigger_deactivate()
    assert read(tmp_path / 'bag') == {'/n': [1, 3]}
    assert node.plain.report[0].lost == 0


def test_split_goes_on_in_a_new_file(tester, record, tmp_path):
    publisher = numbered(tester, 'n')
    node = record()
    heard(tester, publisher)
    send(publisher, 1)
    recorded(tester, node, 1)
    assert tester.ask(Trigger, 'bag_recorder/split', Trigger.Request()).success
    send(publisher, 2)
    recorded(tester, node, 2)
    node.trigger_deactivate()
    assert len(list((tmp_path / 'bag').glob('*.mcap'))) == 2
    assert read(tmp_path / 'bag') == {'/n': [1, 2]}


def test_what_is_excluded_stays_out(tester, record, tmp_path):
    publishers = [numbered(tester, topic) for topic in ('n1', 'n2', 'n3')]
    node = record(exclude_topics=['n2'], exclude_regex='3$')
    heard(tester, publishers[0])
    tester.graph.spin_for(0.3)
    for publisher in publishers:
        send(publisher, 1)
    recorded(tester, node, 1)
    node.trigger_deactivate()
    assert read(tmp_path / 'bag') == {'/n1': [1]}


def test_transforms_are_made_until_somebody_publishes_them(tester, tmp_path, monkeypatch):
    """Whether tf2_msgs is installed tells nothing of that; here another type stands for it."""
    for module in (bag_recorder, recorded_transforms):
        monkeypatch.setattr(module, 'TYPE', 'geometry_msgs/msg/TransformStamped')
    odometry = tester.node.create_publisher(Odometry, 'odom', RELIABLE)
    given = {'output': str(tmp_path / 'bag'), 'topics': ['odom', '/tf']}
    node = tester.start(BagRecorder, **given, storage__keep_free=0.0)

    def say():
        message = Odometry(child_frame_id='base_link')
        message.header.frame_id, message.pose.pose.orientation.w = 'odom', 1.0
        odometry.publish(message)

    heard(tester, odometry)
    say()
    recorded(tester, node, 2)  # odom, and tf of it
    published = tester.node.create_publisher(TransformStamped, '/tf', RELIABLE)
    heard(tester, published)
    say()
    published.publish(TransformStamped(child_frame_id='base_link'))
    recorded(tester, node, 4)
    node.trigger_deactivate()
    assert sorted(topic for topic, _ in texts(tmp_path / 'bag')) == [*['/odom'] * 2, *['/tf'] * 2]


def test_a_disk_at_its_floor_ends_the_recording_with_an_error(tester, record, tmp_path):
    node = record(storage__keep_free=1e9, storage__flush_period=0.05)
    tester.graph.spin_until(lambda: node.plain.recording is None)
    assert 'keep_free' in node.plain.failure
    assert 'keep_free' in node.plain.diagnose().message
    assert read(tmp_path / 'bag') == {}


def test_an_existing_folder_keeps_the_node_inactive(tester, record, tmp_path):
    (tmp_path / 'bag').mkdir()
    with pytest.raises(StartError):
        record()


def test_nothing_to_record_keeps_the_node_unconfigured(tester, record):
    with pytest.raises(StartError):
        record(regex='')


def texts(path):
    """Return topic and type of each message in the order of the bag, by our own reader."""
    with BagReader(path) as bag:
        return [(m.connection.topic, m.connection.type.split('/')[-1]) for m in bag.messages()]


def test_a_topic_that_changes_its_type_is_recorded_on(tester, record, tmp_path):
    logs = tester.logs()
    first = numbered(tester, 'n')
    node = record()
    heard(tester, first)
    send(first, 1, 2)
    recorded(tester, node, 2)
    tester.node.destroy_publisher(first)
    other = rclpy.Context()  # a process of its own: a participant knows one type of a topic
    rclpy.init(context=other, domain_id=tester.graph.context.get_domain_id())
    talker = rclpy.create_node('talker', context=other)
    try:
        second = talker.create_publisher(String, 'n', RELIABLE)
        heard(tester, second)
        for _ in range(3):
            second.publish(String(data='x'))
        recorded(tester, node, 5)
    finally:
        talker.destroy_node()
        other.try_shutdown()
    tester.wait(logs, lambda m: '/n is published as std_msgs/msg/String too' in m.msg)
    node.trigger_deactivate()
    assert texts(tmp_path / 'bag') == [('/n', 'Int32')] * 2 + [('/n', 'String')] * 3
    assert [(t.messages, t.lost) for t in node.plain.report] == [(2, 0), (3, 0)]


def test_under_simulated_time_messages_stand_as_they_arrived(tester, record, tmp_path):
    """The clock stands, and what causes stands before what it causes, on whatever topics."""
    clock = tester.node.create_publisher(Clock, '/clock', RELIABLE)
    topics = [numbered(tester, topic) for topic in ('n3', 'n1', 'n2')]
    node = record(use_sim_time=True)
    tester.graph.repeat(
        lambda: clock.publish(Clock(clock=Time(sec=5))),
        lambda: all(topic.get_subscription_count() for topic in topics),
    )
    said = []
    for i in range(300):
        publisher = topics[i * 7 % 3]
        said.append(publisher.topic_name)
        send(publisher, i)
        assert publisher.wait_for_all_acked()
    recorded(tester, node, 300)
    clock.publish(Clock(clock=Time(sec=6, nanosec=7)))
    assert clock.wait_for_all_acked()
    send(topics[0], 300)
    recorded(tester, node, 301)
    node.trigger_deactivate()
    with BagReader(tmp_path / 'bag') as bag:
        found = list(bag.messages())
    assert [m.connection.topic for m in found] == [*said, '/n3']
    assert {m.stamp for m in found[:-1]} == {5 * 10**9}
    assert found[-1].stamp == 6 * 10**9 + 7


def test_events_of_services_are_recorded_though_their_topics_are_hidden(tester, tmp_path):
    publisher = tester.node.create_publisher(SetBool.Event, 'set/_service_event', RELIABLE)
    hidden = numbered(tester, '_n')
    given = {'output': str(tmp_path / 'bag'), 'all': True, 'storage__keep_free': 0.0}
    node = tester.start(BagRecorder, **given)
    heard(tester, publisher)
    event = SetBool.Event(request=[SetBool.Request(data=True)])
    event.info.sequence_number = 7
    publisher.publish(event)
    send(hidden, 1)
    tester.graph.spin_until(lambda: node.plain.recording.messages >= 1)
    node.trigger_deactivate()
    with BagReader(tmp_path / 'bag') as bag:
        assert '/_n' not in bag.topics
        columns = read_topic(bag, '/set/_service_event')
    assert columns.fields['info.sequence_number'].tolist() == [7]
    assert columns.fields['request.data'].tolist() == [[True]]
