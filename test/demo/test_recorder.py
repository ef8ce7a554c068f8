"""What the recorder of the demo keeps of a topic: its messages, and how it was offered."""

from __future__ import annotations

import errno

import pytest

rclpy = pytest.importorskip('rclpy')

from std_msgs.msg import String

from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.demo.recorder import DemoRecorder, RecordedTopic
from agv_motion.errors import SourceError
from agv_motion.ros.qos import LATCHED, SENSOR

TOPICS = [
    RecordedTopic('way', String, latched=True),
    RecordedTopic('/fix', String),
    RecordedTopic('turned', String, latched=True),
    RecordedTopic('silent', String, latched=True),
]


def test_topics_are_kept_with_the_quality_of_service_that_they_were_offered_with(graph, tmp_path):
    speaker = graph.node('speaker')
    offers = {'way': LATCHED, 'fix': SENSOR, 'turned': LATCHED}
    publishers = [speaker.create_publisher(String, name, qos) for name, qos in offers.items()]
    recorder = DemoRecorder(
        tmp_path / 'bag', TOPICS, lambda: 1_430_438_400_100_000_001, context=graph.context
    )
    graph.add(recorder)
    graph.meet()

    def speak():
        for publisher in publishers:
            publisher.publish(String(data='x'))

    graph.repeat(speak, lambda: sum(map(bool, recorder.counts.values())) == len(offers))
    recorder.close()
    with BagReader(tmp_path / 'bag') as bag:
        (way,), (fix,) = bag.topics['/way'].qos, bag.topics['/fix'].qos
        assert (way.durability, way.reliability) == ('transient_local', 'reliable')
        assert (fix.durability, fix.reliability) == ('volatile', 'best_effort')
        assert bag.topics['/silent'].latched
        assert {message.stamp for message in bag.messages()} == {1_430_438_400_100_000_001}
        assert bag.counts['/silent'] == 0


def test_a_full_disk_ends_the_bag_whole_and_is_told(graph, tmp_path, monkeypatch):
    speaker = graph.node('speaker')
    publisher = speaker.create_publisher(String, 'fix', 10)
    taken, write = [], BagWriter.write

    def write_one(self, *message):
        if taken:
            raise OSError(errno.ENOSPC, 'No space left on device')
        taken.append(message)
        write(self, *message)

    monkeypatch.setattr(BagWriter, 'write', write_one)
    recorder = DemoRecorder(
        tmp_path / 'bag', [RecordedTopic('fix', String)], int, context=graph.context
    )
    graph.add(recorder)
    graph.meet()
    for i in range(3):
        publisher.publish(String(data='x'))
        graph.spin_until(lambda: recorder.counts['fix'] == i + 1)  # noqa: B023 - it is called at once
    assert 'No space left' in recorder.failure
    with pytest.raises(SourceError, match=r'takes no more .* free the disk'):
        recorder.close()
    with BagReader(tmp_path / 'bag') as bag:
        assert bag.message_count == 1
        assert not bag.problems
