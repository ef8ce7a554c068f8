"""What was said last before a moment, however long before: as by looking at all there is."""

from __future__ import annotations

from types import SimpleNamespace as Some

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.bag.last_messages import FIRST, last_before, latest_before

TOPICS = '/a', '/b', '/c'


class Bag:
    """Stands in for a reader; counts the stretches it is asked for."""

    def __init__(self, said):
        self._said = sorted(
            (Some(stamp=stamp, connection=Some(topic=topic)) for stamp, topic in said),
            key=lambda message: message.stamp,
        )
        self.start = min((stamp for stamp, _ in said), default=0)
        self.asked = []

    def require(self, topics):
        self.required = set(topics)

    def messages(self, topics, start, stop):
        self.asked.append((set(topics), start, stop))
        for message in self._said:
            if message.connection.topic in topics and start <= message.stamp < stop:
                yield message


SAID = st.lists(st.tuples(st.integers(0, 40 * FIRST), st.sampled_from(TOPICS)), max_size=40)


@given(
    SAID, st.dictionaries(st.sampled_from(TOPICS), st.integers(0, 4)), st.integers(0, 41 * FIRST)
)
def test_of_each_topic_the_last_are_found(said, counts, moment):
    bag = Bag(said)
    found = latest_before(bag, counts, moment)
    assert bag.required == set(counts)
    assert [one.stamp for one in found] == sorted(one.stamp for one in found)
    for topic in TOPICS:
        before = sorted(stamp for stamp, name in said if name == topic and stamp < moment)
        mine = [one.stamp for one in found if one.connection.topic == topic]
        assert mine == before[len(before) - min(counts.get(topic, 0), len(before)) :]


def test_stretches_grow_by_four_and_only_what_is_missing_is_read_in_them():
    moment = 100 * FIRST
    bag = Bag([(0, '/a'), (moment - 2 * FIRST, '/b'), (moment - 1, '/c')])
    found = last_before(bag, TOPICS, moment)
    assert {topic: message.stamp for topic, message in found.items()} == {
        '/a': 0, '/b': moment - 2 * FIRST, '/c': moment - 1,
    }  # fmt: skip
    edges = [moment - n * FIRST for n in (0, 1, 5, 21, 85)]
    assert bag.asked == [
        (set(TOPICS), edges[1], edges[0]),
        ({'/a', '/b'}, edges[2], edges[1]),
        ({'/a'}, edges[3], edges[2]),
        ({'/a'}, edges[4], edges[3]),
        ({'/a'}, 0, edges[4]),
    ]


def test_what_was_found_in_one_stretch_is_not_sought_in_the_next():
    """Of two that are wanted one lies near, and three far away: only the last of these is told."""
    moment = 100 * FIRST
    bag = Bag([(moment - 1, '/a'), *((moment - 2 * FIRST - n, '/a') for n in range(3))])
    found = latest_before(bag, {'/a': 2}, moment)
    assert [one.stamp for one in found] == [moment - 2 * FIRST, moment - 1]


@pytest.mark.parametrize('looks', [0, 1, 3])
def test_who_has_enough_is_content_with_what_was_found(looks):
    bag = Bag([(0, '/a')])
    answers = iter([False] * looks + [True])
    assert last_before(bag, ['/a'], 100 * FIRST, lambda: next(answers)) == {}
    assert len(bag.asked) == looks
