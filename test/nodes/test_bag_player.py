"""The player on a real graph."""

from __future__ import annotations

import pytest

rclpy = pytest.importorskip('rclpy')

from rcl_interfaces.msg import Log
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import serialize_message
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Float64, Int32
from std_srvs.srv import Trigger

from agv_motion.bag.quality_of_service import OfferedQos
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import ConfigurationError
from agv_motion.nodes.bag_player import CLOCK, BagPlayer, _overrides
from agv_motion.ros.messages import seconds_of
from agv_motion.ros.run import StartError

SECOND = 1_000_000_000
START = 1000 * SECOND
DEEP = QoSProfile(depth=1000)


@pytest.fixture
def bag(tmp_path):
    """Return a bag of 2 s: 100 numbers, and one latched at the start."""
    latched = [OfferedQos(durability='transient_local', depth=1)]
    weak = [OfferedQos(reliability='best_effort')]
    with BagWriter(tmp_path / 'bag') as writer:
        number = writer.add_topic('/number', 'std_msgs/msg/Int32', qos=weak)
        once = writer.add_topic('/once', 'std_msgs/msg/Int32', qos=latched)
        writer.write(once, START, serialize_message(Int32(data=-1)))
        for i in range(100):
            writer.write(number, START + i * SECOND // 50, serialize_message(Int32(data=i)))
    return str(tmp_path / 'bag')


@pytest.fixture
def play(tester, bag):
    """Return a function that starts a player of the bag, inactive until its listeners are found."""

    def start(*, activate=True, listeners=1, **given):
        node = tester.start(BagPlayer, activate=False, bag=bag, **given)
        node.trigger_configure()
        tester.graph.spin_until(
            lambda: node.count_subscribers('/number') + node.count_subscribers('/once') >= listeners
        )
        tester.graph.meet()
        if activate:
            node.trigger_activate()
        return node

    return start


def test_all_numbers_in_order_and_what_is_latched_for_who_comes_late(tester, play, qos):
    inbox = tester.listen(
        Int32, '/number', QoSProfile(depth=1000, reliability=qos['sensor'].reliability)
    )
    node = play(rate=10.0)
    tester.graph.spin_until(node.plain.playing.finished.is_set)
    tester.wait(inbox, lambda m: m.data == 99)
    assert [m.data for m in inbox] == list(range(100))
    late = tester.listen(Int32, '/once', qos['latched'])
    tester.wait(late, lambda m: m.data == -1)
    assert node.plain.diagnose().message == 'finished'


def test_topics_are_offered_as_they_were_recorded_or_as_overridden(tester, play, tmp_path):
    overrides = tmp_path / 'qos.yaml'
    overrides.write_text('/number: {reliability: reliable, durability: volatile, depth: 7}\n')

    def offered(topic):
        (info,) = tester.node.get_publishers_info_by_topic(topic)
        return info.qos_profile.reliability, info.qos_profile.durability

    node = play(activate=False, listeners=0)
    assert offered('/number') == (ReliabilityPolicy.BEST_EFFORT, DurabilityPolicy.VOLATILE)
    assert offered('/once') == (ReliabilityPolicy.RELIABLE, DurabilityPolicy.TRANSIENT_LOCAL)
    node.trigger_cleanup()
    play(activate=False, listeners=0, qos_overrides=str(overrides))
    tester.graph.spin_until(lambda: len(tester.node.get_publishers_info_by_topic('/number')) == 1)
    assert offered('/number') == (ReliabilityPolicy.RELIABLE, DurabilityPolicy.VOLATILE)


def test_seek_by_service_after_the_end_sends_again(tester, play, qos):
    inbox = tester.listen(
        Int32, '/number', QoSProfile(depth=1000, reliability=qos['sensor'].reliability)
    )
    node = play(rate=20.0)
    tester.wait(inbox, lambda m: m.data == 99)
    tester.graph.spin_until(node.plain.playing.finished.is_set)

    def ask(name):
        return tester.ask(Trigger, f'bag_player/{name}', Trigger.Request())

    assert not ask('resume').success
    assert not ask('play_next').success
    inbox.clear()
    node.set_parameters([Parameter('seek_to', value=1.9)])
    assert ask('seek').success
    tester.wait(inbox, lambda m: m.data == 99)
    assert [m.data for m in inbox] == [95, 96, 97, 98, 99]


@pytest.mark.parametrize(
    ('text', 'message'),
    [
        ('/once: {reliability: bestest}', r'qos\.yaml.*bestest.*choose one of.*best_effort'),
        ('/once: {reliability: 17}', 'choose one of'),
        ('/once: {durabilty: volatile}', "no durabilty; did you mean 'durability'"),
        ('/once: {depth: -1}', 'depth must lie in'),
        ('/once: {depth: 1.5}', 'depth'),
        ('/once: 7', 'expected'),
    ],
)
def test_a_word_that_ros_does_not_know_is_refused(tmp_path, text, message):
    (tmp_path / 'qos.yaml').write_text(text)
    with pytest.raises(ConfigurationError, match=message):
        _overrides(str(tmp_path / 'qos.yaml'))


def test_topics_of_the_file_that_are_not_played_are_told(tester, play, tmp_path):
    (tmp_path / 'qos.yaml').write_text('/numbers: {depth: 5}\n/once: {depth: 5}\n')
    logs = tester.listen(Log, '/rosout', DEEP)
    play(activate=False, listeners=0, qos_overrides=str(tmp_path / 'qos.yaml'))
    tester.wait(logs, lambda m: "no topic '/numbers' is played; did you mean '/number'?" in m.msg)
    assert not any("'/once'" in m.msg for m in logs)


def test_messages_of_another_type_on_a_topic_are_told_and_not_sent_as_what_they_are_not(
    tester, tmp_path
):
    with BagWriter(tmp_path / 'two') as writer:
        for i, kind in enumerate((Int32(data=5), Float64(data=1.5), Int32(data=6))):
            name = f'std_msgs/msg/{type(kind).__name__}'
            handle = i + 1 if i < 2 else 1
            if i < 2:
                assert writer.add_topic('/number', name) == handle
            writer.write(handle, START + i, serialize_message(kind))
    logs = tester.listen(Log, '/rosout', DEEP)
    inbox = tester.listen(Int32, '/number', DEEP)
    node = tester.start(BagPlayer, activate=False, bag=str(tmp_path / 'two'))
    node.trigger_configure()
    tester.graph.meet()
    node.trigger_activate()
    tester.wait(inbox, lambda m: m.data == 6)
    assert [m.data for m in inbox] == [5, 6]
    tester.wait(logs, lambda m: 'its messages of type std_msgs/msg/Float64 are not played' in m.msg)


def test_the_clock_tells_the_time_of_the_bag(tester, play):
    times = tester.listen(Clock, '/clock', CLOCK)
    node = play(listeners=0, clock=100.0, rate=4.0)
    tester.graph.spin_until(node.plain.playing.finished.is_set)
    seconds = [seconds_of(message.clock) for message in times]
    assert seconds == sorted(seconds)
    assert seconds[0] < 1000.5
    assert seconds[-1] > 1001.5


def test_pause_next_burst_seek_and_rate_by_services_and_parameters(tester, play, qos):
    inbox = tester.listen(
        Int32, '/number', QoSProfile(depth=1000, reliability=qos['sensor'].reliability)
    )

    def ask(name):
        return tester.ask(Trigger, f'bag_player/{name}', Trigger.Request())

    node = play(start_paused=True)
    assert ask('play_next').success
    assert ask('play_next').success
    assert ask('play_next').success
    tester.wait(inbox, lambda m: m.data == 1)
    node.set_parameters([Parameter('burst', value=10), Parameter('seek_to', value=1.5)])
    assert ask('burst').success
    tester.wait(inbox, lambda m: m.data == 11)
    assert len(inbox) == 12
    assert ask('seek').success
    (result,) = node.set_parameters([Parameter('rate', value=20.0)])
    assert result.successful
    assert ask('toggle_paused').message == 'playing'
    assert not ask('play_next').success
    tester.wait(inbox, lambda m: m.data == 99)
    assert [m.data for m in inbox[12:]] == list(range(75, 100))
    assert node.plain.playing.rate == 20.0
    (result,) = node.set_parameters([Parameter('rate', value=0.0)])
    assert not result.successful


def test_deactivation_stops_it_and_activation_begins_again(tester, play, qos):
    inbox = tester.listen(
        Int32, '/number', QoSProfile(depth=1000, reliability=qos['sensor'].reliability)
    )
    node = play()
    tester.wait(inbox)
    node.trigger_deactivate()
    assert len(inbox) < 90
    tester.graph.quiet(inbox)
    node.trigger_activate()
    tester.graph.spin_until(lambda: 0 in [m.data for m in inbox])


def test_a_bag_that_is_not_there_keeps_the_node_unconfigured(tester, tmp_path):
    for given in ({}, {'bag': str(tmp_path / 'nowhere')}):
        with pytest.raises(StartError):
            tester.start(BagPlayer, **given)
