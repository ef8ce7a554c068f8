"""Some minutes of a bag, with what had been told before."""

from __future__ import annotations

from agv_motion.bag import BagReader, BagWriter, OfferedQos
from agv_motion.bag.editing.excerpt import save_excerpt
from agv_motion.bag.last_messages import last_before

SECOND = 1_000_000_000
LATCHED = (OfferedQos(durability='transient_local'),)


def text(word):
    data = word.encode() + b'\0'
    return b'\0\1\0\0' + len(data).to_bytes(4, 'little') + data


def written(folder):
    with BagWriter(folder) as bag:
        state = bag.add_topic('/state', 'std_msgs/msg/String', 'string data', qos=LATCHED)
        talk = bag.add_topic('/talk', 'std_msgs/msg/String', 'string data')
        bag.write(state, 1 * SECOND, text('walking'))
        for second in range(2, 1000):
            bag.write(talk, second * SECOND, text(str(second)))
        bag.write(state, 1000 * SECOND, text('resting'))
    return folder


def test_what_was_told_last_is_found_however_long_ago(tmp_path):
    with BagReader(written(tmp_path / 'bag')) as bag:
        found = last_before(bag, ['/state', '/talk'], 900 * SECOND)
        assert {topic: m.stamp // SECOND for topic, m in found.items()} == {
            '/state': 1, '/talk': 899,
        }  # fmt: skip
        assert last_before(bag, ['/state'], 1 * SECOND) == {}
        assert last_before(bag, ['/state'], 900 * SECOND, lambda: True) == {}


def test_an_excerpt_holds_its_time_and_what_latched_topics_had_told(tmp_path):
    with BagReader(written(tmp_path / 'bag')) as bag, BagWriter(tmp_path / 'cut') as cut:
        assert save_excerpt(bag, cut, 500 * SECOND, 503 * SECOND) == 4
    with BagReader(tmp_path / 'cut') as bag:
        told = [(m.connection.topic, m.stamp // SECOND, m.data) for m in bag.messages()]
        assert bag.topics['/state'].latched
    assert told == [
        ('/state', 500, text('walking')),
        *(('/talk', second, text(str(second))) for second in (500, 501, 502)),
    ]
