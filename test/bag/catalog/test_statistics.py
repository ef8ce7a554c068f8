"""The amounts of a season."""

from __future__ import annotations

import pytest

from agv_motion.bag.catalog.discovery import size
from agv_motion.bag.catalog.entry import BagEntry, TopicEntry
from agv_motion.bag.catalog.find import Question
from agv_motion.bag.catalog.index import BagIndex
from agv_motion.bag.catalog.statistics import Period, amounts, topic_amounts

DAY = 86400
SECOND = 10**9


def test_the_amounts_of_a_season(season):
    (season / 'loose.mcap').unlink()
    with BagIndex(season) as index:
        index.update()
        (whole,) = amounts(index, Question(), None, 60.0)
        assert (whole.bags, whole.messages, whole.gaps) == (3, 87, 2)
        assert whole.seconds == pytest.approx(3.9 + 3.9 + 0.3)
        assert whole.longest_gap == pytest.approx(40 * DAY - 203.9)
        assert whole.size == sum(size(season / name) for name in ('north/a', 'b', 'c'))
        months = amounts(index, Question(), Period.MONTH, 200.0)
        assert [(m.name, m.bags, m.gaps) for m in months] == [('2024-05', 2, 0), ('2024-06', 1, 0)]
        days = amounts(index, Question(end='2024-06'), Period.DAY, 60.0)
        assert [(d.name, d.bags, d.gaps) for d in days] == [('2024-05-01', 2, 1)]
        topics = {t.name: (t.bags, t.messages) for t in topic_amounts(index, Question())}
        assert topics == {
            '/a': (3, 36),
            '/b': (2, 14),
            '/c': (2, 14),
            '/map': (3, 3),
            '/x': (1, 20),
        }


def test_amounts_by_hand(tmp_path):
    """A from 1 s before midnight to 3 s after it, c within it, b from 5 to 9 s after midnight."""
    entries = {
        'a.mcap': BagEntry((DAY - 1) * SECOND, (DAY + 3) * SECOND, 10, 100, '', (
            TopicEntry('/a', 'a/msg/A', 10, 50.0),)),
        'b.mcap': BagEntry((DAY + 5) * SECOND, (DAY + 9) * SECOND, 4, 7, '', (
            TopicEntry('/a', 'a/msg/A', 3, None), TopicEntry('/b', 'a/msg/A', 1, 8.0))),
        'c.mcap': BagEntry((DAY + 1) * SECOND, (DAY + 2) * SECOND, 1, 1, '', ()),
        'd.mcap': BagEntry(fault='torn'),
    }  # fmt: skip
    for name in entries:
        (tmp_path / name).touch()
    with BagIndex(tmp_path) as index:
        report = index.update(read=lambda paths: ((path, entries[path.name]) for path in paths))
        assert report == (4, 4, 0, 1)
        everything = Question()
        assert amounts(index, everything, None, 2.0) == [('all', 3, 9.0, 15, 108, 1, 2.0)]
        assert amounts(index, everything, None, 2.5) == [('all', 3, 9.0, 15, 108, 0, 0.0)]
        assert amounts(index, everything, Period.DAY, 2.0) == [
            ('1970-01-01', 1, 4.0, 10, 100, 0, 0.0), ('1970-01-02', 2, 5.0, 5, 8, 1, 3.0),
        ]  # fmt: skip
        assert topic_amounts(index, everything) == [
            ('/a', 'a/msg/A', 2, 8.0, 13, None), ('/b', 'a/msg/A', 1, 4.0, 1, 8.0),
        ]  # fmt: skip
