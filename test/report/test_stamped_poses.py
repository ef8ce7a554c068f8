"""Which poses belong together, why none do, and what is no pose."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.report.stamped_poses import associate, stamped_poses


def at(milliseconds, name='/odom'):
    """Return poses whose x [m] is their time."""
    stamp = np.array(milliseconds, dtype=np.int64) * 10**6
    places = np.outer(stamp * 1e-9, [1.0, 0.0, 0.0])
    return stamped_poses(name, 'map', stamp, places, np.tile([0.0, 0, 0, 1], (len(stamp), 1)))


def together(first, second, **options):
    pair = associate(at(first, '/truth'), at(second), **options)
    return [(poses.stamp // 10**6).tolist() for poses in pair]


def test_each_of_the_fewer_gets_the_nearest_and_of_two_the_earlier():
    few, many = [95, 200, 305, 400], [90, 100, 200, 301, 320, 389]
    expected = [95, 200, 305], [90, 200, 301]
    assert together(few, many) == list(expected)
    assert together(many, few) == list(expected[::-1])
    assert together(few, many, within=0.011) == [few, [90, 200, 301, 389]]
    assert together([10, 20, 30], [10, 20, 30], within=0.0) == [[10, 20, 30]] * 2


def test_the_order_is_that_of_the_stamps_and_the_first_of_equal_ones_counts():
    poses = at([30, 10, 20, 10])
    assert (poses.stamp // 10**6).tolist() == [10, 20, 30]
    assert poses.position[:, 0] == pytest.approx([0.01, 0.02, 0.03])


def test_an_offset_sets_a_clock_right():
    assert together([1000, 1100, 1200], [0, 100, 200], offset=1.0) == [
        [1000, 1100, 1200], [0, 100, 200]
    ]  # fmt: skip


@pytest.mark.parametrize(
    ('first', 'second', 'why'),
    [
        ([0, 100, 200], [5000, 5100, 5250],
         r'one spans 0\.200 s, the other 0\.250 s, .* begins 5\.000 s after .*--offset -5\.000'),
        ([5000, 5100, 5200], [0, 100, 200], r'begins 5\.000 s before /truth.*--offset 5\.000'),
        ([0, 100, 200, 300], [50, 151, 252], r'third nearest are 0\.05 s .*--within 0\.0505'),
        ([0, 100, 200], [0, 100], r'at least 3 of each: /truth has 3; /odom has 2'),
        ([0, 0, 0, 0], [0, 100, 200], '/truth has 1'),
        ([0, 100, 200], [], '/odom has 0'),
    ],
)  # fmt: skip
def test_why_fewer_than_three_belong_together(first, second, why):
    with pytest.raises(ConfigurationError, match=why):
        together(first, second)


@pytest.mark.parametrize('number', [float('nan'), float('inf'), -1.0, 1e300])
def test_a_limit_that_is_none_is_refused(number):
    with pytest.raises(ConfigurationError, match='--within'):
        together([0, 100, 200], [0, 100, 200], within=number)
    with pytest.raises(ConfigurationError, match=r'--offset|do not overlap'):
        together([0, 100, 200], [0, 100, 200], offset=number)


@pytest.mark.parametrize(
    ('place', 'turn', 'why'),
    [
        ([np.nan, 0, 0], [0, 0, 0, 1], r'1 of 3 poses have .* not finite.* nan 0 0 0 0 0 1 at 5\.'),
        ([0, np.inf, 0], [0, 0, 0, 1], 'not finite'),
        ([0, 0, 0], [0, 0, 0, np.nan], 'not finite'),
        ([0, 0, 1e8], [0, 0, 0, 1], r'over 1e\+07 m'),
        ([0, 0, 0], [0, 0, 0, 0], 'not of length 1'),
        ([0, 0, 0], [0, 0, 1, 1], 'not of length 1'),
    ],
)
def test_what_is_no_pose_is_refused_with_its_time(place, turn, why):
    places, turns = np.zeros((3, 3)), np.tile([0.0, 0, 0, 1], (3, 1))
    places[1], turns[1] = place, turn
    with pytest.raises(SourceError, match=f'/odom: .*{why}'):
        stamped_poses('/odom', 'map', np.array([4, 5, 6]) * 10**9, places, turns)
