"""The buffer: fixes that come late, in any order, leave the same belief as fixes in time."""

from __future__ import annotations

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.odometry.alignment import FixAtPose
from agv_motion.odometry.belief import Drift, believe
from agv_motion.odometry.covariance import Covariance, scale
from agv_motion.odometry.fix import position_fix
from agv_motion.odometry.fix_buffer import FixBuffer
from agv_motion.odometry.history import Waypoint
from agv_motion.planar import Pose

NOISE = Covariance(1e-3, 0.0, 0.0, 1e-3, 0.0, 1e-4)
PRIOR = Covariance(0.1, 0.0, 0.0, 0.1, 0.0, 0.1)
DRIFT = Drift(1e-6, 1e-8)


def at(stamp):
    """Return where odometry sees the robot: straight on at 1 m/s, ever less certain."""
    return Waypoint(stamp, Pose(stamp, 0.0, 0.0), scale(NOISE, stamp))


def sightings(seed, count, outliers=0.2):
    """Return fixes around the truth, some of them far out."""
    chance, found = random.Random(seed), []  # noqa: S311
    for i in range(1, count + 1):
        far = 5.0 if chance.random() < outliers else 0.0
        x, y = chance.gauss(i, 0.15) + far, chance.gauss(0.0, 0.15)
        found.append(FixAtPose(position_fix(float(i), x, y, 0.15), at(float(i))))
    return found


def started():
    return FixBuffer(believe(Pose(0.1, -0.1, 0.05), PRIOR, at(0.0)), DRIFT, 0.999)


@given(st.integers(0, 10**6), st.integers(1, 15))
def test_the_order_of_arrival_does_not_matter(seed, count):
    in_time, shuffled = started(), started()
    fixes = sightings(seed, count)
    for sighting in fixes:
        in_time.take(sighting)
    random.Random(seed).shuffle(fixes)  # noqa: S311
    for sighting in fixes:
        shuffled.take(sighting)
    assert shuffled.belief == in_time.belief
    assert shuffled.rejected() == in_time.rejected()


def test_an_outlier_changes_nothing():
    buffer = started()
    before = buffer.belief
    assert not buffer.take(FixAtPose(position_fix(1.0, 9.0, 0.0, 0.15), at(1.0)))
    assert buffer.belief == before
    assert buffer.take(FixAtPose(position_fix(2.0, 2.0, 0.0, 0.15), at(2.0)))
    assert buffer.belief != before


def test_an_outlier_that_passed_a_wide_gate_is_outvoted():
    """After a silence one is 2 m unsure: an outlier of 4 m passes, then four sound fixes do not."""
    wide = believe(Pose(0.0, 0.0, 0.0), Covariance(4.0, 0.0, 0.0, 4.0, 0.0, 0.01), at(0.0))
    fooled, spared = FixBuffer(wide, DRIFT, 0.999), FixBuffer(wide, DRIFT, 0.999)
    assert fooled.take(FixAtPose(position_fix(1.0, 5.0, 0.0, 0.15), at(1.0)))
    sound = [FixAtPose(position_fix(2.0 + i, 2.1 + i, 0.0, 0.15), at(2.0 + i)) for i in range(4)]
    passed = []
    for sighting in sound:
        passed.append(fooled.take(sighting))
        fooled.forget(sighting.fix.stamp - 0.5)
    assert passed == [False, False, True, True]
    assert [spared.take(sighting) for sighting in sound] == [True] * 4
    assert fooled.belief == spared.belief


def test_an_outlier_is_outvoted_however_many_fixes_came_before_it():
    """Ten sound ones, a silence of half an hour, one 4 m off, and sound ones again."""
    buffer = started()
    for stamp in (*range(1, 11), 2000):
        off = 4.0 if stamp == 2000 else 0.0
        assert buffer.take(FixAtPose(position_fix(stamp, stamp + off, 0.0, 0.15), at(stamp)))
    passed = [
        buffer.take(FixAtPose(position_fix(stamp, stamp, 0.0, 0.15), at(stamp)))
        for stamp in range(2001, 2005)
    ]
    assert passed == [False, False, True, True]


def test_a_sound_fix_is_not_outvoted_by_outliers():
    buffer = started()
    sound = FixAtPose(position_fix(1.0, 1.0, 0.0, 0.15), at(1.0))
    assert buffer.take(sound)
    belief = buffer.belief
    for i in range(6):
        buffer.take(FixAtPose(position_fix(2.0 + i, 9.0 + i, 9.0, 0.15), at(2.0 + i)))
    assert buffer.belief == belief


def test_sound_fixes_pass_as_often_as_the_gate_says():
    passed = total = 0
    for seed in range(150):
        buffer = FixBuffer(believe(Pose(0.0, 0.0, 0.0), scale(PRIOR, 0.01), at(0.0)), DRIFT, 0.95)
        for sighting in sightings(seed, 20, outliers=0.0):
            passed += buffer.take(sighting)
            total += 1
    assert passed / total == pytest.approx(0.95, abs=0.03)


def test_what_is_forgotten_stays_believed():
    buffer, fixes = started(), sightings(1, 10, outliers=0.0)
    for sighting in fixes:
        buffer.take(sighting)
    belief = buffer.belief
    buffer.forget(before=6.0)
    assert buffer.belief == belief
    assert buffer.start == 5.0
    assert fixes[6] in buffer
    assert fixes[3] not in buffer
    buffer.forget(before=99.0)
    assert buffer.belief == belief


@pytest.mark.parametrize('period', [0.05, 0.5, 2.0])
def test_rejected_fixes_are_kept_that_span_the_last_seconds(period):
    """However often they come: few of them, over 10 s, the newest and the oldest among them."""
    buffer = started()
    assert buffer.take(FixAtPose(position_fix(1.0, 1.0, 0.0, 0.15), at(1.0)))
    far = []
    for i in range(round(60.0 / period)):
        stamp = 2.0 + period * i
        far.append(FixAtPose(position_fix(stamp, -50.0, 0.0, 0.15), at(stamp)))
        buffer.take(far[-1])
        buffer.forget(stamp - 1.0)
    kept = buffer.rejected()
    assert set(kept) <= set(far)
    assert kept[-1] is far[-1]
    assert len(kept) <= 24
    span = kept[-1].fix.stamp - kept[0].fix.stamp
    assert 10.0 <= span <= 10.0 + max(6.0 * period, 3.0)


def test_few_rejected_fixes_are_kept_however_old():
    buffer = started()
    assert buffer.take(FixAtPose(position_fix(1.0, 1.0, 0.0, 0.15), at(1.0)))
    far = [FixAtPose(position_fix(20.0 * i, -50.0, 0.0, 0.15), at(20.0 * i)) for i in range(1, 9)]
    for sighting in far:
        buffer.take(sighting)
        buffer.forget(sighting.fix.stamp - 1.0)
    assert buffer.rejected() == far
