"""Months of a probe, and what happens in them, day by day beside the same tree without it.

What a logger shows is made from a tree whose sap flow is known; the twin is read through the same
chain, from a logger and a probe to which nothing happens.
"""

from __future__ import annotations

import json
from datetime import datetime, timezone
from functools import cache
from math import exp, isfinite, nan, pi, sin
from types import SimpleNamespace
from zoneinfo import ZoneInfo

import numpy as np
import pytest

from agv_motion.probe import Probe, ProbeParameters
from agv_motion.probe.loss import LossParameters
from agv_motion.probe.quality import Quality
from agv_motion.probe.sources.csv_file import CsvSource, GrowingSource
from agv_motion.probe.sources.csv_parameters import CsvParameters
from agv_motion.probe.sources.serial_line import SerialParameters, SerialSource
from agv_motion.probe.zero_flow_method import ZeroFlowMethodName
from agv_motion.simulation.trials.probe_losses import Tree

HOUR, DAY = 3600.0, 86400.0
QUARTER = 900.0
SPRING = datetime(2015, 3, 2, tzinfo=timezone.utc).timestamp()
ZERO_FLOW = 20.0
"""[K] dT of the probe without flow"""
LEARNT = 5
"""Days after which the tree is known"""


def flow(time):
    """Return K of the tree: none at night, up to 0.12 by day, a third of it on dull days."""
    hour = time % DAY / HOUR
    if not 8.0 < hour < 21.0:
        return 0.0
    fair = (0.4, 0.7, 0.9, 1.0, 0.6)[int(time // DAY) % 5]
    return 0.12 * fair * sin(pi * (hour - 8.0) / 13.0) ** 1.5


def noise(time):
    """Return noise of 0.01 K and steps of the logger of 0.005 K, the same whenever it is asked."""
    return 0.005 * round(4.0 * sin(time * 12.9898) * sin(time * 0.0178))


def shown(time, zero_flow=ZERO_FLOW, index=None):
    """Return dT [K] at ``time`` [s]."""
    return zero_flow / (1.0 + (flow(time) if index is None else index)) + noise(time)


def ticks(days, step=QUARTER, begin=SPRING):
    return [begin + k * step for k in range(int(days * DAY / step))]


def sap_flow(times, values, parameters=None):
    """Return the sap flow of each reading, NaN where the tree rests, and zero flow beside it."""
    probe = Probe(parameters or ProbeParameters())
    readings = [probe.update(*row) for row in zip(times, values, strict=True)]
    return np.array(
        [[nan if x is None else x for x in (r.sap_flow, r.zero_flow)] for r in readings]
    ).T


@cache
def _twin(times):
    return sap_flow(times, [shown(time) for time in times])[0]


def twin(times):
    """Return the sap flow of the tree to which nothing happens; it is that of many tests."""
    return _twin(tuple(times))


def by_day(error, times):
    """Return the largest error of each day, 0 where the tree rested, and the share it rested."""
    days = ((np.array(times) - SPRING) // DAY).astype(int)
    rows = [error[days == day] for day in range(days[-1] + 1)]
    worst = np.array([np.nanmax(np.abs(row), initial=0.0) for row in rows])
    return worst, np.array([np.isnan(row).mean() for row in rows])


@pytest.mark.parametrize('method', ['predawn', 'moving_window', 'double_regression'])
@pytest.mark.parametrize('end', [14.0, 26.0])
def test_a_zero_flow_that_drifts_is_followed_day_by_day(end, method):
    """By 6 K in three months: 0.07 K a day, a thirtieth of what flows at noon."""
    times = ticks(90, 2 * QUARTER)
    drift = [ZERO_FLOW + (end - ZERO_FLOW) * (time - SPRING) / (90 * DAY) for time in times]
    values = [shown(*row) for row in zip(times, drift, strict=True)]
    found, zero_flow = sap_flow(times, values, ProbeParameters(zero_flow_method=method))
    worst, rested = by_day(found - twin(times), times)
    assert worst[LEARNT:].max() < 0.15
    assert not rested[LEARNT:].any()
    late = np.abs(zero_flow - drift)[LEARNT * 48 :]
    assert late.max() < 0.25


@pytest.mark.parametrize('gap', [0.0, 3.0 * HOUR])
@pytest.mark.parametrize('new', [12.0, 15.5, 24.0])
@pytest.mark.parametrize('hour', [3.0, 10.0, 15.0])
def test_a_needle_that_is_replaced_rests_until_its_first_night_is_over(new, gap, hour):
    """It is never read by the zero flow of the old one: that would be a torrent, or none."""
    times = [t for t in ticks(13) if not 0.0 <= t - (at := SPRING + 9 * DAY + hour * HOUR) < gap]
    values = [shown(time, ZERO_FLOW if time < at else new) for time in times]
    found, zero_flow = sap_flow(times, values)
    true = twin(times)
    known = at + gap + (31.0 * HOUR - (at + gap) % DAY) % DAY
    known += DAY if known - at - gap < 2.0 * HOUR else 0.0  # the rest of a night is no night
    after = np.array([time >= known for time in times])
    between = np.array([at <= time for time in times]) & ~after
    assert not np.nanmax(found[between] - true[between], initial=0.0) > 0.1
    assert not np.isnan(found[after]).any()
    worst, _ = by_day(np.where(after, found - true, 0.0), times)
    assert worst.max() < 0.1
    assert np.allclose(zero_flow[after], new, atol=0.05)


@pytest.mark.parametrize('month', [3, 10])
def test_a_clock_of_local_time_leaps_an_hour_and_the_tree_goes_on(month):
    """A file without its zone, read as UTC: summer time begins and ends within four weeks."""
    begin = datetime(2015, month, 15, tzinfo=timezone.utc).timestamp()
    times = ticks(28, begin=begin)
    zone = ZoneInfo('Europe/Zurich')
    local = [t + datetime.fromtimestamp(t, zone).utcoffset().total_seconds() for t in times]
    values = [shown(time) for time in times]
    found, zero_flow = sap_flow(local, values)
    true, true_zero_flow = sap_flow(times, values)
    assert not np.isnan(found[LEARNT * 96 :]).any()
    assert np.abs(found - true)[LEARNT * 96 :].max() < 0.05
    assert np.abs(zero_flow - true_zero_flow)[LEARNT * 96 :].max() < 0.03


def test_a_file_of_local_time_is_read_by_its_zone_over_both_ends_of_summer(tmp_path):
    times = ticks(240, 2 * QUARTER)
    zone = ZoneInfo('Europe/Zurich')
    rows = (f'{datetime.fromtimestamp(t, zone):%Y-%m-%d %H:%M},{shown(t):.3f}\n' for t in times)
    path = tmp_path / 'oak.csv'
    path.write_text('time,a\n' + ''.join(rows))
    source = CsvSource(given_csv(path, time_zone='Europe/Zurich'), 0.0)
    assert [s.time for s in (*source.read(0.0), *source.read(1e9))] == times
    assert source.complaint() == f'{path} has come to its end'


def given_csv(path, **given):
    return CsvParameters(file=str(path), columns=('a',), day_offsets=(0.0,), unit='K', **given)


def lines_of(rows, form='%d-%m-%y %H:%M:%S'):
    """Return what a serial source makes of lines, each read when it is written: (now, sample)."""
    source = SerialSource(SerialParameters(port='none', fields=(1,), unit='K'))
    told = []
    for now, time, value in rows:
        word = datetime.fromtimestamp(time, timezone.utc).strftime(form)
        data = f'{word} {value:.3f}\r\n'.encode()
        source._line = SimpleNamespace(read=lambda _, data=data: data)  # noqa: SLF001 - no port
        told += [(now, sample) for sample in source.read(now)]
    return told, source


RESET = SPRING + 12 * DAY + 9 * HOUR, SPRING + 12 * DAY + 15 * HOUR + QUARTER
"""[s] between which the clock of a logger counts from its beginning"""


@pytest.mark.parametrize('year', [1990, 2000])
def test_a_logger_whose_clock_begins_anew_is_not_read_until_it_is_set(year):
    anew = datetime(year, 1, 1, tzinfo=timezone.utc).timestamp()
    times = ticks(20)
    clock = [anew + t - RESET[0] if RESET[0] <= t < RESET[1] else t for t in times]
    told, source = lines_of(zip(times, clock, map(shown, times), strict=True))
    assert [sample.time for _, sample in told] == [now for now, _ in told]
    assert not any(RESET[0] <= now < RESET[1] for now, _ in told)
    assert 'the clock of the logger was not set' in source.complaint()
    found, _ = sap_flow(*zip(*((s.time, s.values[0]) for _, s in told), strict=True))
    kept = [t for t in times if not RESET[0] <= t < RESET[1]]
    true, _ = sap_flow(kept, [shown(time) for time in kept])
    assert not np.isnan(found[LEARNT * 96 :]).any()
    assert np.abs(found - true)[LEARNT * 96 :].max() < 0.05


@pytest.mark.parametrize('year', [1990, 2000])
@pytest.mark.parametrize('newest_first', [False, True])
def test_rows_of_a_clock_that_began_anew_are_left_out_of_a_file(year, newest_first, tmp_path):
    """They would stand before all others, and the file would begin decades too early."""
    anew = datetime(year, 1, 1, tzinfo=timezone.utc).timestamp()
    times = ticks(20)
    clock = [anew + t - RESET[0] if RESET[0] <= t < RESET[1] else t for t in times]
    rows = [
        f'{datetime.fromtimestamp(c, timezone.utc):%Y-%m-%d %H:%M},{shown(t):.3f}\n'
        for c, t in zip(clock, times, strict=True)
    ]
    path = tmp_path / 'oak.csv'
    path.write_text('time,a\n' + ''.join(rows[::-1] if newest_first else rows))
    source = CsvSource(given_csv(path), 0.0)
    read = [s.time for s in (*source.read(0.0), *source.read(1e9))]
    assert read == [t for t in times if not RESET[0] <= t < RESET[1]]
    source = CsvSource(given_csv(path), 0.0)
    assert 'left out: 25' in (complaint := source.complaint())
    assert 'the clock had begun anew' in complaint


def test_a_file_that_is_followed_survives_a_clock_that_leaps(tmp_path):
    """Back to 2000 and on to 2063: neither is read, and the rows after it are."""
    path = tmp_path / 'oak.csv'
    path.write_text('time,a\n')
    times = ticks(3)
    odd = {50: datetime(2000, 1, 1, 0, 30), 100: datetime(2063, 5, 1), 101: datetime(2063, 5, 2)}  # noqa: DTZ001
    source, read = None, []
    for k, time in enumerate(times):
        moment = odd.get(k) or datetime.fromtimestamp(time, timezone.utc)
        with path.open('a') as file:
            file.write(f'{moment:%Y-%m-%d %H:%M},{shown(time):.3f}\n')
        source = source or GrowingSource(given_csv(path, follow=True), 1.0)
        read += [(time, sample.time) for sample in source.read(time)]
    assert read == [(t, t) for k, t in enumerate(times) if k and k not in odd]
    complaint = source.complaint()
    assert 'rows are older' in complaint
    assert 'rows are days ahead of the clock here: left out; set the logger' in complaint
    anew = GrowingSource(given_csv(path, follow=True), 1.0)
    assert [s.time for s in anew.history(times[-1])][-1] == times[-1]
    with path.open('a') as file:
        file.write(f'{times[-1] + QUARTER:.0f},9\n')
    assert [s.time for s in anew.read(times[-1] + QUARTER)] == [times[-1] + QUARTER]


@pytest.mark.parametrize('method', [each.value for each in ZeroFlowMethodName][:3])
@pytest.mark.parametrize('days', [-400.0, -5.0, -1.0, 400.0])
def test_a_clock_that_is_set_by_days_loses_the_past_and_not_the_future(days, method):
    """Zero flow falls by 0.1 K a night meanwhile: that of old nights would tell a steady flow."""
    times = ticks(24)
    falling = [ZERO_FLOW - 0.1 * (time - SPRING) / DAY for time in times]
    clock = [time + (days * DAY if time >= SPRING + 10 * DAY else 0.0) for time in times]
    values = [shown(*row) for row in zip(times, falling, strict=True)]
    given = ProbeParameters(zero_flow_method=method)
    found, zero_flow = sap_flow(clock, values, given)
    worst, rested = by_day(found - twin(times), times)
    assert worst[LEARNT:].max() < 0.25
    assert rested[LEARNT:10].max() == rested[13:].max() == 0.0
    late = np.abs(zero_flow - falling)[LEARNT * 96 :]
    assert np.nanmax(late) < 0.45


def cuts_of(rng, days):
    """Return when power goes and comes: for seconds to three days, two days apart."""
    time, cuts = SPRING + LEARNT * DAY, []
    while time < SPRING + (days - 1) * DAY:
        length = exp(rng.uniform(np.log(60.0), np.log(3.0 * DAY)))
        cuts.append((time, time + length))
        time += length + rng.uniform(1.0, 3.0) * DAY
    return cuts


def test_power_cuts_never_move_a_tree_by_a_heater_that_warms_up():
    """The needles warm up as 1 - exp(-t/10 min); the node too starts anew, from what it kept."""
    rng, step, days = np.random.default_rng(5), 60.0, 14
    cuts = cuts_of(rng, days)
    given = ProbeParameters()
    probe, other = Probe(given), Probe(given)
    worst, rested, allowed, last_cut = 0.0, 0, 0, 0.0
    for time in ticks(days, step):
        true = other.update(time, shown(time)).sap_flow
        if any(begin <= time < end for begin, end in cuts):
            continue
        back = max((end for _, end in cuts if end <= time), default=0.0)
        if back != last_cut:
            state, probe, last_cut = json.loads(json.dumps(probe.state())), Probe(given), back
            probe.restore(state)
        warm = 1.0 - exp(-(time - back) / 600.0)
        found = probe.update(time, shown(time) * warm).sap_flow
        if time < SPRING + LEARNT * DAY:
            continue
        if found is not None:
            worst = max(worst, found - true)
        rested += found is None
        allowed += time - back < 36 * HOUR
    assert worst < 0.3  # of fair noon, three quarters of an hour after the heater is on
    assert rested <= allowed


@pytest.mark.parametrize('resolution', [0.001, 0.025])
@pytest.mark.parametrize('sigma', [0.01, 0.05])
def test_a_frozen_tree_stands_still_for_weeks_and_drinks_again_in_spring(resolution, sigma):
    times = ticks(70)
    frozen = SPRING + 14 * DAY, SPRING + 49 * DAY
    rng = np.random.default_rng(3)
    values = [
        resolution * round((shown(t, index=0.0 if frozen[0] <= t < frozen[1] else None)
                            + rng.normal(0.0, sigma)) / resolution)
        for t in times
    ]  # fmt: skip
    found, zero_flow = sap_flow(times, values)
    cold = np.array([frozen[0] + 2 * DAY <= t < frozen[1] for t in times])
    assert np.nanmax(found[cold]) < 4.0 * sigma
    assert np.nanmax(np.abs(zero_flow[cold] - ZERO_FLOW)) < 5.0 * sigma
    spring = np.array([t >= frozen[1] + 9 * DAY for t in times])
    true = twin(times)
    assert not np.isnan(found[spring]).any()
    assert np.abs(found - true)[spring].max() < 0.25


def test_a_frozen_probe_that_shows_the_same_for_weeks_is_told_as_stuck():
    times = ticks(20)
    probe = Probe(ProbeParameters())
    readings = [probe.update(t, shown(t) if t < SPRING + 10 * DAY else 20.0) for t in times]
    assert {r.quality for r in readings[11 * 96 :]} == {Quality.STUCK}
    assert all(r.sap_flow is None for r in readings[11 * 96 :])


def test_three_probes_over_a_winter_of_everything_never_move_by_what_is_no_flow():
    """Drift, noise, cuts, a new needle and a clock of local time, with the ladder of loss."""
    rng = np.random.default_rng(8)
    tree = Tree(LossParameters(hold=900.0, trend=1800.0, climatology=7200.0))
    worst, moved = 0.0, 0
    for time in ticks(60):
        day = int((time - SPRING) // DAY)
        index = 0.0 if 20 <= day < 45 else None
        base = [20.0 + 0.02 * day, 13.0 if day >= 30 else 19.0, 18.0 - 0.01 * day]
        values = [shown(time, z, index) for z in base]
        if day % 11 == 7:
            values[day % 3] = float(rng.choice([nan, 0.3, abs(rng.normal(0.0, 2.0)), 400.0]))
        clock = time + (HOUR if day >= 27 else 0.0)
        told = tree.update(clock, tuple(values)).values
        assert all(isfinite(v) and 0.0 <= v <= 1.0 for v in told)
        if told and 23 <= day < 45:
            worst = max(worst, told[0])
            moved += 1
    assert worst < 0.1
    assert moved > 20 * 60
