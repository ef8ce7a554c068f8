"""A whole probe: the real spruce by day and by night, causality, restart."""

from __future__ import annotations

import json
from datetime import datetime, timezone
from math import nan, pi, sin

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.probe import state_file
from agv_motion.probe.parameters import ProbeParameters
from agv_motion.probe.probe import Probe
from agv_motion.probe.quality import Quality
from agv_motion.probe.sources.csv_parameters import CsvParameters
from agv_motion.probe.sources.csv_recording import load
from agv_motion.probe.sources.source import kelvin, kelvin_per

DAY = 86400.0


def clear_day(time):
    """A diurnal curve: 20 K at night, 18.5 K at 14:00."""
    hour = time % DAY / 3600.0
    return 20.0 - 1.5 * max(sin(pi * (hour - 8.0) / 12.0), 0.0) + 0.001 * (hour % 1.0)


def readings(days, step=900.0, **parameters):
    probe = Probe(ProbeParameters(**parameters))
    times = np.arange(0.0, days * DAY, step)
    return times, [probe.update(t, clear_day(t)) for t in times], probe


def test_it_learns_for_a_day_and_a_night_then_follows_the_day():
    times, seen, _ = readings(4)
    assert all(r.sap_flow is None for t, r in zip(times, seen, strict=True) if t < 1.2 * DAY)
    late = [(t % DAY / 3600.0, r.sap_flow) for t, r in zip(times, seen, strict=True) if t > 2 * DAY]
    assert max(flow for hour, flow in late if hour < 7.0 or hour > 21.0) < 0.05
    assert min(flow for hour, flow in late if 13.0 < hour < 15.0) > 0.9


def test_the_sampling_rate_does_not_matter():
    _, coarse, _ = readings(3, step=900.0)
    _, fine, _ = readings(3, step=60.0)
    assert fine[::15][-40].sap_flow == pytest.approx(coarse[-40].sap_flow, abs=0.03)


def test_polarity_turns_the_share_round():
    _, straight, _ = readings(3)
    _, turned, _ = readings(3, polarity='more_flow_is_0')
    assert turned[-40].sap_flow == pytest.approx(1.0 - straight[-40].sap_flow)


def test_the_original_range_follows_the_raw_value():
    _, seen, _ = readings(3, normalisation='range', opening_range=1.0)
    flows = [r.sap_flow for r in seen[96:]]
    assert min(f for f in flows if f is not None) == pytest.approx(0.0, abs=0.01)
    assert max(f for f in flows if f is not None) == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize(
    ('value', 'quality'),
    [
        (nan, Quality.MISSING), (0.2, Quality.OFF), (5.0, Quality.OUT_OF_RANGE),
        (70.0, Quality.OUT_OF_RANGE),
    ],
)  # fmt: skip
def test_what_cannot_be_believed_has_no_sap_flow(value, quality):
    _, _, probe = readings(3)
    for k in range(5):
        reading = probe.update(3 * DAY + 900.0 * k, value)
    assert reading.quality is quality
    assert reading.sap_flow is None


@pytest.mark.parametrize('polarity', ['more_flow_is_1', 'more_flow_is_0'])
@pytest.mark.parametrize('normalisation', ['quantiles', 'range'])
@pytest.mark.parametrize(('unit', 'noise'), [('mV', 0.045), ('uV', 45.0), ('V', 45e-6), ('K', 1.1)])
def test_the_noise_of_a_half_dead_probe_is_no_sap_flow(polarity, normalisation, unit, noise):
    """Round 0.1 mV and round nothing, from the first reading and after good days."""
    chance, factor = np.random.default_rng(1), kelvin_per(unit)
    for days in (0, 3):
        _, _, probe = readings(days, polarity=polarity, normalisation=normalisation)
        for level in (0.0, 2.2 * noise):
            for k, raw in enumerate(level + chance.uniform(-noise, noise, 300)):
                reading = probe.update(days * DAY + 900.0 * k, kelvin(raw, factor))
                assert reading.quality is Quality.OFF
                assert reading.sap_flow is None
                assert reading.flux_density is None


def test_above_zero_flow_is_no_flow_and_is_said():
    _, _, probe = readings(3)
    reading = probe.update(3 * DAY, 20.5)
    assert reading.quality is Quality.NEGATIVE_FLOW
    assert reading.sap_flow == 0.0


def test_a_restart_needs_no_week(tmp_path):
    _, _, first = readings(3)
    path = tmp_path / 'deep' / 'probes.json'
    state_file.save(path, [first])
    second = Probe(ProbeParameters())
    assert state_file.restore(path, [second]) == ''
    now = 3 * DAY + 14 * 3600.0
    assert second.update(now, 18.5).sap_flow == pytest.approx(first.update(now, 18.5).sap_flow)


def state(nights, normaliser):
    """Return the state of one probe as its file has it."""
    probe = f'{{"zero_flow": {{"nights": [{nights}]}}, "normaliser": {normaliser}}}'
    return f'{{"version": 1, "probes": [{probe}]}}'


@pytest.mark.parametrize(
    'content',
    [
        '', '{', '[]', '{"version": 1, "probes": []}', '{"version": 1, "probes": [{}]}',
        '[' * 100_000,
        '9' * 5000,
        state('[1e999, 20.0]', '{"bins": []}'),
        state('[1, NaN]', '{"bins": []}'),
        state('', '{"bins": [[0.0, NaN]]}'),
        state('', '{"bins": [[-Infinity, 0.0]]}'),
        state('', '{"bins": [[1' + '0' * 400 + ', 0.0]]}'),
        state('', '{"range": [0.0, 1.0]}'),
    ],
)  # fmt: skip
def test_a_state_that_cannot_be_used_is_set_aside(tmp_path, content):
    path = tmp_path / 'probes.json'
    path.write_text(content)
    assert 'set aside as' in state_file.restore(path, [Probe(ProbeParameters())])
    assert (tmp_path / 'probes.json.unusable').read_text() == content
    assert not path.exists()


def test_a_state_of_which_one_half_is_unusable_is_taken_up_by_no_probe(tmp_path):
    _, _, learnt = readings(3)
    path = tmp_path / 'probes.json'
    state_file.save(path, [learnt, learnt])
    content = json.loads(path.read_bytes().partition(b'\n')[2])
    content['probes'][1] = {}
    path.write_text(json.dumps(content))
    probes = [Probe(ProbeParameters()), Probe(ProbeParameters())]
    assert 'set aside as' in state_file.restore(path, probes)
    assert probes[0].state() == Probe(ProbeParameters()).state()


def test_a_state_of_the_time_before_digests_is_taken_up(tmp_path):
    _, _, learnt = readings(3)
    path = tmp_path / 'probes.json'
    path.write_text(json.dumps({'version': 1, 'probes': [learnt.state()]}))
    again = Probe(ProbeParameters())
    assert state_file.restore(path, [again]) == ''
    assert again.state() == learnt.state()


def test_a_folder_is_refused_and_stays(tmp_path):
    with pytest.raises(ConfigurationError, match='is a folder'):
        state_file.restore(tmp_path, [])
    assert tmp_path.is_dir()


@pytest.mark.parametrize(
    ('change', 'word'),
    [
        ({'low_quantile': 0.9, 'high_quantile': 0.5}, 'not below high_quantile'),
        ({'night_start': 8.0}, 'not below night_end'),
        ({'zero_flow_days': 0}, 'zero_flow_days = 0'),
        ({'polarity': 'upside_down'}, 'choose one of'),
        ({'highest': nan}, 'finite'),
    ],
)
def test_parameters_that_make_no_sense_are_refused(change, word):
    with pytest.raises(ConfigurationError, match=word):
        ProbeParameters(**change)


@pytest.fixture(scope='module')
def year(spruce, tmp_path_factory):
    """Return (local hour, month, share, quality) from one November to the next July."""
    path = tmp_path_factory.mktemp('year') / 'spruce.csv'
    head, *rows = spruce.read_text(encoding='utf-8').splitlines(keepends=True)
    path.write_text(head + ''.join(row for row in rows if '2012-11' <= row < '2013-08'))
    recording = load(CsvParameters(file=str(path), columns=('delta_v_mv',), day_offsets=(0.0,)))
    times, values = recording.times, recording.values
    probe = Probe(ProbeParameters(solar_offset=0.5))
    seen = [probe.update(t, float(v)) for t, v in zip(times, values[:, 0], strict=True)]
    hours = (np.array(times) / 3600.0 + 0.5) % 24.0
    months = np.array([datetime.fromtimestamp(t, timezone.utc).month for t in times])
    flow = np.array([nan if r.sap_flow is None else r.sap_flow for r in seen])
    return hours, months, flow, [r.quality for r in seen]


def test_the_spruce_drinks_by_day_and_rests_by_night(year):
    hours, months, flow, _ = year
    known = ~np.isnan(flow) & (months >= 5) & (months <= 9)
    night, day = known & ((hours < 5.0) | (hours > 23.0)), known & (hours > 10.0) & (hours < 17.0)
    assert (flow[night] < 0.15).mean() > 0.94
    assert np.median(flow[day]) > 0.5
    assert (flow[day] > 0.15).mean() > 0.7


def test_the_months_with_the_sensor_off_give_nothing(year):
    _, months, flow, quality = year
    assert np.isnan(flow[(months == 1) | (months == 2)]).all()
    assert sum(q is Quality.OFF for q in quality) > 9_000
