"""The amounts of a season."""

from __future__ import annotations

import pytest

from agv_motion.bag.catalog.discovery import size
from agv_motion.bag.catalog.find import Question
from agv_motion.bag.catalog.index import BagIndex
from agv_motion.bag.catalog.statistics import Period, amounts, topic_amounts

DAY = 86400


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
