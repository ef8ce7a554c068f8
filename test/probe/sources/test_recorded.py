"""Recorded readings, put together again."""

from __future__ import annotations

from math import isnan, nan

from agv_motion.probe.environment import Environment
from agv_motion.probe.sources.recorded import RecordedSource
from agv_motion.probe.sources.simulated import SimulatedSource, SimulatedSourceParameters
from agv_motion.probe.sources.source import ProbeSample

LIVE = SimulatedSource(SimulatedSourceParameters(), 1.0)


def test_readings_of_one_time_are_one_sample():
    source = RecordedSource(LIVE, 3)
    for probe in (2, 0, 1):
        source.take(probe, 100.0, 20.0 + probe)
    (sample,) = source.read(100.0)
    assert sample == ProbeSample(100.0, (20.0, 21.0, 22.0))
    assert source.read(101.0) == []


def test_a_probe_that_says_nothing_is_missing_after_a_while():
    source = RecordedSource(LIVE, 2)
    source.take(1, 100.0, 21.0)
    assert source.read(100.2) == []
    (sample,) = source.read(101.0)
    assert isnan(sample.values[0])
    assert sample.values[1] == 21.0


def test_the_air_of_a_time_belongs_to_the_readings_of_that_time():
    source = RecordedSource(LIVE, 1)
    source.take_environment(100.0, Environment(500.0, 0.8))
    for time in (100.0, 101.0):
        source.take(0, time, 20.0)
    first, second = source.read(102.0)
    assert first.environment == (500.0, 0.8)
    assert isnan(second.environment.radiation)


def test_samples_of_one_stamp_are_of_the_times_of_their_logger():
    source = RecordedSource(LIVE, 2)
    for time, values in ((10.0, (20.0, 21.0)), (20.0, (nan, 22.0)), (30.0, (nan, nan))):
        source.take_time(100.0, time)
        source.take_environment(100.0, Environment(time, 0.8))
        for probe, value in enumerate(values):
            if value == value:  # noqa: PLR0124 - a value that is missing is not told
                source.take(probe, 100.0, value)
    found = source.read(101.0)
    assert [sample.time for sample in found] == [10.0, 20.0, 30.0]
    assert [sample.environment.radiation for sample in found] == [10.0, 20.0, 30.0]
    assert str([sample.values for sample in found]) == '[(20.0, 21.0), (nan, 22.0), (nan, nan)]'


def test_what_comes_twice_at_one_stamp_is_of_the_next_sample():
    source = RecordedSource(LIVE, 1)
    for value in (20.0, 21.0):
        source.take(0, 100.0, value)
    assert [sample.values for sample in source.read(100.0)] == [(20.0,), (21.0,)]


def test_samples_come_in_the_order_of_time():
    source = RecordedSource(LIVE, 1)
    source.take(0, 102.0, 2.0)
    source.take(0, 101.0, 1.0)
    assert [sample.time for sample in source.read(103.0)] == [101.0, 102.0]


def test_history_is_that_of_the_live_source():
    now = 1434326400.0
    assert list(RecordedSource(LIVE, 3).history(now)) == list(LIVE.history(now))
