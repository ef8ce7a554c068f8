"""Bags are found by what is in them, and when a condition was met."""

from __future__ import annotations

import pytest

from agv_motion.bag.catalog.find import Question, find, limits
from agv_motion.bag.catalog.index import BagIndex
from agv_motion.bag.sqlite.file import LATEST
from agv_motion.errors import ConfigurationError

SECOND = 10**9
MAY = 1_714_521_600


def names(folder, **asked):
    with BagIndex(folder) as index:
        index.update()
        return [str(one.path.relative_to(index.folder)) for one in find(index, Question(**asked))]


@pytest.mark.parametrize(('asked', 'found'), [
    ({}, ['north/a', 'b', 'c', 'loose.mcap']),
    ({'topics': ('/x',)}, ['b']), ({'topics': ('/x', '/b')}, []), ({'topics': ('/?',)},
     ['north/a', 'b', 'c', 'loose.mcap']),
    ({'types': ('std_msgs/*',), 'end': '2024-06'}, ['north/a', 'b']),
    ({'types': ('nav_msgs/msg/Odometry',)}, []),
    ({'begin': '2024-05-01', 'end': '2024-05-02'}, ['north/a', 'b']),
    ({'begin': '2024-05-01T00:03'}, ['b', 'c', 'loose.mcap']),
    ({'begin': '2024-05-02'}, ['c', 'loose.mcap']),
    ({'end': f'@{MAY + 200}'}, ['north/a']), ({'end': '1'}, ['north/a']),
    ({'begin': '-0.35'}, ['c', 'loose.mcap']),
])  # fmt: skip
def test_bags_are_found_by_topic_type_and_time(season, asked, found):
    assert names(season, **asked) == found


@pytest.mark.parametrize(('asked', 'span'), [
    ({}, (0, LATEST)), ({'begin': '2', 'end': '3'}, (2 * SECOND, 3 * SECOND)),
    ({'begin': '@9300000000', 'end': '@9400000000'}, (LATEST, LATEST)),
])  # fmt: skip
def test_times_without_bags_count_from_nothing_and_end_where_sqlite_does(tmp_path, asked, span):
    with BagIndex(tmp_path) as index:
        assert limits(index, Question(**asked)) == span
        assert list(find(index, Question(**asked))) == []


def test_when_a_condition_was_met(season):
    with BagIndex(season) as index:
        index.update()
        complaints = []
        found = list(find(index, Question(where="/x == 'word 7'"), complain=complaints.append))
        (one,) = found
        stamp = (MAY + 200) * SECOND + 7 * SECOND // 10
        assert (one.path.name, one.spans) == ('b', ((stamp, stamp),))
        everywhere = list(find(index, Question(where='/a ~ word', end='2024-06')))
        assert [len(one.spans) for one in everywhere] == [1, 1]
        assert list(find(index, Question(where='/a ~ rain'))) == []
        with pytest.raises(ConfigurationError, match='is in none of 4 bags'):
            list(find(index, Question(where='/odom > 5')))
        with pytest.raises(ConfigurationError, match='is no condition'):
            list(find(index, Question(where='rain')))
        with pytest.raises(ConfigurationError, match='earlier one first'):
            list(find(index, Question(begin='2024-06', end='2024-05')))
