"""Every reading of one spruce in 2.7 years, against an independent chain in numpy.

The chain is written from the definitions alone and in another form: columns and days, where the
probe takes one reading after another. It uses nothing of the package.
"""

from __future__ import annotations

import csv
from datetime import datetime

import numpy as np
import pytest

from agv_motion.probe import ProbeParameters, read_series
from agv_motion.probe.environment import Environment, EnvironmentParameters

DAY, HOUR = 86400.0, 3600.0
OFF, HIGHEST, TOO_MUCH, SPIKE = 5.0, 60.0, 2.0, 0.15
NIGHT = 2 * HOUR, 7 * HOUR


def predawn(nights, day, days):
    return nights[max(nights)]


def moving_window(nights, day, days):
    return np.max([value for each, value in nights.items() if each > day - days])


def double_regression(nights, day, days):
    window = np.array([value for each, value in nights.items() if each > day - days])
    return np.mean(window[window - np.mean(window) > -1e-9])  # coarse loggers are on the mean


METHODS = {
    'predawn': predawn, 'moving_window': moving_window, 'double_regression': double_regression,
    'environment': predawn,
}  # fmt: skip


class Chain:
    """Columns of one probe: flags, dT_max, K and F of each reading."""

    def __init__(self, series, method, days, offset):
        """Fill them from time, dT and sun [W/m2], which the environment asks, for 30 days."""
        (self.time, self.difference, self.sun), self.method = series, method
        time, difference = self.time, self.difference
        self.days = 30 if method == 'environment' else days
        self.day, self.second = np.divmod(time + offset * HOUR, DAY)
        self.flags = self._flags_of_one_reading()
        self.stood = self._stood()
        self.zero_flow = np.full(len(time), np.nan)
        self.nights, self.dt_max, self.flowing = {}, np.nan, False
        self.level, self.suspects, self.line, self.back, self.doubt = [], [], [], '', []
        self.night, self.of_day, self.pending = [[]], -1, (np.nan, 0)
        first = np.flatnonzero(np.diff(self.day, prepend=-1.0))
        for rows in np.split(np.arange(len(time)), first[1:]):
            self._of_one_day(rows)
        heated = self.flags == 'good'
        k = np.where(heated, self.zero_flow / np.where(heated, difference, 1.0) - 1.0, np.nan)
        self.index = np.where(heated, (self.zero_flow - difference) / difference, np.nan)
        assert np.allclose(k, self.index, atol=1e-12, rtol=0.0, equal_nan=True)
        self.flags = np.where(self.index < 0.0, 'negative flow', self.flags)
        flux = 42.84 / 100.0 / 3600.0 * 118.99 / 119.0  # Granier's two ways to write one constant
        assert abs(flux - 118.99e-6) < 1e-9
        self.flux = np.where(
            np.isnan(k), np.nan, 118.99e-6 * np.exp(1.231 * np.log(np.maximum(k, 1e-300)))
        )

    def _flags_of_one_reading(self):
        told = np.nan_to_num(self.difference, nan=1.0)
        flags = np.where(told < OFF, 'off', np.where(told > HIGHEST, 'out of range', 'good'))
        return np.where(np.isnan(self.difference), 'missing', flags).astype('<U16')

    def _stood(self):
        """Return how long the very same value has stood at each reading in range [s]."""
        stood = np.full(len(self.time), np.nan)
        rows = np.flatnonzero(self.flags == 'good')
        times, values = self.time[rows], self.difference[rows]
        gap = np.diff(times, prepend=-np.inf) >= 6 * HOUR
        begins = gap | (np.diff(values, prepend=np.nan) != 0.0)
        stood[rows] = (
            times - times[np.maximum.accumulate(np.where(begins, np.arange(len(rows)), 0))]
        )
        self.gaps = set(rows[gap].tolist())
        return stood

    def _of_one_day(self, rows):
        dark = (self.second[rows] >= NIGHT[0]) & (self.second[rows] < NIGHT[1])
        before = rows[self.second[rows] < NIGHT[0]]
        after = rows[self.second[rows] >= NIGHT[1]]
        self._believe(before)
        self._believe(rows[dark])
        told = int(self.day[rows[0]]) == self.of_day
        self.pending = self._night() if told else np.nan, self.of_day
        self._believe(after)
        self._latch()

    def _believe(self, rows):
        """Flag rows by what was before them, and keep those of a night that can be used."""
        columns = self.difference[rows], self.flags[rows], self.stood[rows], self.second[rows]
        table = zip(rows.tolist(), *(column.tolist() for column in columns), strict=True)
        for row, value, flag, stood, second in table:
            if flag == 'off':
                self.level, self.line, self.back, self.doubt = [], [], 'off', []
            if flag != 'good':
                continue
            if row in self.gaps:
                self.level, self.line, self.doubt = [], [], []
            if stood >= (4 if self.flowing else 18) * HOUR:
                self.flags[row] = 'stuck'
                continue
            if not self._fits(value):
                self.flags[row] = 'spike'
            if not self._stands_still(row, value):
                continue
            self._use(row, dark=NIGHT[0] <= second < NIGHT[1])
            self._forget(int(self.day[row]))
            self.zero_flow[row] = self.dt_max
            if np.isfinite(self.dt_max):
                self.flowing = (self.dt_max - value) / value > 0.02

    def _use(self, row, *, dark):
        """Keep a row of a night; the first after it ends it."""
        if not dark:
            self._latch()
            return
        if self.day[row] != self.of_day:
            self.night, self.of_day = [[]], int(self.day[row])
        self.night[-1].append(row)

    def _stands_still(self, row, value):
        """Flag noise, what was off until all stand still, and too much flow."""
        self.line, self.doubt = [*self.line[-6:], value], [*self.doubt[-13:], row]
        off = np.abs(np.diff(self.line, 2)) / 2.0 > 0.015 * np.array(self.line[1:-1])
        if off.sum() >= 4:
            self.back = 'noise'
        elif len(off) == 5 and not off.any():
            self.back = ''
        if self.flags[row] == 'good' and self.back:
            self.flags[row] = self.back
            if self.back == 'noise':
                self._take_back(self.doubt[0])
        elif self.flags[row] == 'good' and (self.dt_max - value) / value > TOO_MUCH:
            self.flags[row] = 'out of range'
        return self.flags[row] == 'good'

    def _fits(self, value):
        middle = sorted(self.level[-5:])[2] if len(self.level) >= 5 else value
        if abs(value - middle) <= SPIKE * middle:
            self.level, self.suspects = [*self.level[-4:], value], []
            return True
        self.suspects = [*self.suspects[-2:], value]
        middle = sum(sorted(self.suspects)[(len(self.suspects) - 1) // 2 :][:1])
        if len(self.suspects) == 3 and abs(value - middle) <= SPIKE * middle:
            self.level, self.suspects = self.suspects, []
            return True
        return False

    def _take_back(self, since):
        """Let the last night tell what it told before the row ``since``."""
        self.night = [[row for row in rows if row < since] for rows in self.night] + [[]]
        told = self._night()
        if np.isfinite(self.pending[0]):
            self.pending = told, self.of_day
        elif self.of_day in self.nights and self.nights[self.of_day] != told:
            del self.nights[self.of_day]
            if np.isfinite(told):
                self.nights[self.of_day] = told
            level = METHODS[self.method]
            self.dt_max = level(self.nights, self.of_day, self.days) if self.nights else np.nan

    def _night(self):
        """Return the highest median of three readings of a night, NaN where it tells nothing."""
        values = [self.difference[rows] for rows in self.night if len(rows) > 2]
        if not values:
            return np.nan
        middles = [np.median([v[:-2], v[1:-1], v[2:]], axis=0) for v in values]
        last = np.concatenate([rows[2:] for rows in self.night if len(rows) > 2])
        at = last[np.argmax(np.concatenate(middles))]
        highest = np.max(np.concatenate(middles))
        return highest if self.method != 'environment' or self._quiet(at) else np.nan

    def _quiet(self, at):
        near = np.flatnonzero(
            (self.time > self.time[at] - 2 * HOUR)
            & (self.time <= self.time[at])
            & ((self.flags == 'good') | (self.flags == 'negative flow'))
        )
        values, sun = self.difference[near], self.sun[near]
        if len(near) < 3 or np.ptp(self.time[near]) < 1.5 * HOUR or np.isnan(sun).all():
            return False
        still = np.std(values, ddof=1) / np.mean(values) <= 0.005
        return still and np.nanmean(sun) <= 30.0

    def _latch(self):
        value, day = getattr(self, 'pending', (np.nan, 0))
        if np.isfinite(value):
            self.nights[day] = value
            recent = {each: v for each, v in self.nights.items() if each > day - self.days}
            self.nights = recent
            self.dt_max = METHODS[self.method](recent, day, self.days)
        self.pending = np.nan, 0

    def _forget(self, day):
        if self.nights and day - max(self.nights) > self.days:
            self.nights, self.dt_max = {}, np.nan


SUN_ALONE = EnvironmentParameters(vpd_below=0.0)


def own_series(days=24):
    """Return time, dT [K] and sun of a tree with dull days, spikes, gaps, hours off, of noise."""
    rng = np.random.default_rng(5)
    time = 1.37e9 // DAY * DAY + np.arange(0.0, days * DAY, 900.0)
    hour, day = time % DAY / 3600.0, (time - time[0]) // DAY
    bright = 0.3 + 0.7 * rng.random(days)[day.astype(int)]
    sun = 800.0 * bright * np.maximum(np.sin(np.pi * (hour - 5.0) / 15.0), 0.0)
    sun += 60.0 * (day % 3 == 1)  # nights that are not dark, in which sap flows
    flow = bright * np.maximum(np.sin(np.pi * (hour - 7.0) / 14.0), 0.0) + 0.15 * (day % 3 == 1)
    value = (20.0 + 0.4 * np.sin(day / 3.0)) / (1.0 + 0.12 * flow)
    value = np.round(value + 0.02 * rng.normal(size=len(time)), 3)
    value[rng.random(len(time)) < 0.01] = np.nan
    value[rng.random(len(time)) < 0.01] *= 1.4
    value[300:340], value[700:720], value[900:990] = 0.3, value[700], value[900]
    for day_of_noise, first in ((4, 12), (6, 24), (19, 17), (21, 22)):  # before dawn, and over it
        begin = 96 * day_of_noise + first
        value[begin : begin + 12] = rng.normal(20.5, 0.6, 12)
    keep = (np.arange(len(time)) < 1200) | (np.arange(len(time)) > 1700)
    return time[keep], value[keep], sun[keep]


@pytest.fixture(scope='module')
def of_the_spruce(spruce):
    """Return time, dT [K] and sun of all its readings."""
    with spruce.open(encoding='utf-8') as file:
        rows = list(csv.DictReader(file))
    time = [datetime.fromisoformat(row['time'].replace('Z', '+00:00')).timestamp() for row in rows]
    voltage, sun = (
        np.array([float(row[name] or 'nan') for row in rows])
        for name in ('delta_v_mv', 'solar_w_m2')
    )
    return np.array(time), 25.0 * voltage, sun


def compare(series, method, days):
    time, difference, sun = series
    offset = 0.5
    told = read_series(
        time, difference,
        ProbeParameters(
            zero_flow_method=method, zero_flow_days=days, solar_offset=offset,
            environment=SUN_ALONE, normalisation='range',
        ),
        [Environment(radiation=each) for each in sun.tolist()],
    )  # fmt: skip
    chain = Chain(series, method, days, offset)
    flags = np.array([quality.value for quality in told.quality])
    sign_is_known = ~(np.abs(chain.index) < 1e-12)
    differ = np.flatnonzero((flags != chain.flags) & sign_is_known)
    assert not len(differ), f'{flags[differ[0]]}, not {chain.flags[differ[0]]}, in row {differ[0]}'
    usable = (chain.flags == 'good') | (chain.flags == 'negative flow')
    for ours, theirs, unit in (
        (told.zero_flow, chain.zero_flow, 1.0), (told.flow_index, chain.index, 1.0),
        (told.flux_density, chain.flux, 1e-6),
    ):  # fmt: skip
        np.testing.assert_allclose(ours[usable], theirs[usable], rtol=1e-12, atol=1e-12 * unit)
    return told, chain


@pytest.mark.parametrize('method', METHODS)
def test_a_month_by_each_method(method):
    told, chain = compare(own_series(), method, 5)
    found = {'good', 'negative flow', 'off', 'spike', 'stuck', 'missing', 'noise'}
    assert found <= set(chain.flags)
    assert np.isfinite(told.flux_density).sum() > 500


@pytest.mark.parametrize('method', METHODS)
def test_the_spruce_by_each_method(of_the_spruce, method):
    """Each reading by one of them: they share the years, two thirds of a year each."""
    parts = zip(*(np.array_split(column, len(METHODS)) for column in of_the_spruce), strict=True)
    series = dict(zip(METHODS, parts, strict=True))[method]
    told, chain = compare(series, method, 3 if method == 'moving_window' else 7)
    assert len(chain.time) > 22_000
    assert np.isfinite(told.flux_density).sum() > 13_000


def test_the_methods_are_four():
    levels = [compare(own_series(), method, 5)[0].zero_flow for method in METHODS]
    known = np.isfinite(np.sum(levels, axis=0))
    assert known.sum() > 500
    means = {method: level[known].mean() for method, level in zip(METHODS, levels, strict=True)}
    assert means['predawn'] < means['double_regression'] < means['moving_window']
    assert abs(means['environment'] - means['predawn']) > 1e-3
