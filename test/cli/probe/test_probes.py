"""`agv probes`, as a person types it: what it prints reads the file."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

import yaml

from agv_motion.nodes.granier_probe import GranierProbeParameters
from agv_motion.probe.sources.csv_recording import load
from agv_motion.ros.parameters import filled

ROWS = 'Datum;Zeit;dT_1 [mV];Wind\n' + ''.join(
    f'{1 + i // 24:02}.06.2013;{i % 24:02}:00;0,{700 - 40 * abs(i % 24 - 12)};{i % 7}\n'
    for i in range(96)
    if not 30 < i < 34
)


def test_what_it_prints_reads_the_file(alone, tmp_path):
    file = tmp_path / 'oak.csv'
    file.write_text(ROWS + 'end of data;;;\n')
    plain, picture = tmp_path / 'plain.csv', tmp_path / 'oak.png'
    status, out, errors = alone('probes', file, '--to', plain, '--plot', picture)
    assert status == 0, errors
    assert 'rows: 93, every 1 h, from 2013-06-01T00:00:00Z to 2013-06-04T23:00:00Z' in out
    assert 'gap: 4 h after 2013-06-02T06:00:00Z' in out
    assert 'left out: 1 (line 95: ' in out
    assert 'probe [mV]' in out
    assert 'other columns: Datum, Zeit, Wind' in out
    assert picture.read_bytes().startswith(b'\x89PNG')
    told = yaml.safe_load(out[out.index('granier_probe:') : out.index('\nWritten')])
    values = told['granier_probe']['ros__parameters']
    values |= {f'csv.{name}': value for name, value in values.pop('csv').items()}
    given = filled(GranierProbeParameters, values, 'granier_probe')
    found = load(given.csv)
    assert found.values[0, 0] == pytest.approx(25.0 * 0.220)
    assert plain.read_text().splitlines()[:2] == ['time,dT_1 [mV]', '2013-06-01T00:00:00Z,0.22']
    status, _, errors = alone('probes', file, '--to', plain)
    assert status == 1
    assert 'is there already' in errors


def test_two_readings_are_told_and_one_is_chosen(alone, tmp_path):
    file = tmp_path / 'us.csv'
    file.write_text('time,probe_1\n6/10/2013 12:00 AM,0.5\n6/10/2013 12:30 AM,0.6\n')
    status, out, errors = alone('probes', file)
    assert status == 1
    assert 'day_first or month_first' in out
    assert 'choose by --time-format' in errors
    status, out, _ = alone('probes', file, '--time-format', 'month_first')
    assert status == 0
    assert 'from 2013-06-10T00:00:00Z to 2013-06-10T00:30:00Z' in out
    assert 'time_format: "month_first"' in out


def test_what_a_tree_drank_is_told_for_each_day(alone, tmp_path):
    file = tmp_path / 'oak.csv'
    file.write_text(
        'time,probe_1_mV\n'
        + ''.join(
            f'2013-06-{1 + k // 96:02}T{k % 96 // 4:02}:{k % 4 * 15:02}:00Z,{v:.5f}\n'
            for k in range(3 * 96)
            for v in [0.8 - 0.05 * max(0.0, 1.0 - abs(k % 96 - 56) / 24.0) + 1e-4 * (k % 3)]
        )
    )
    picture = tmp_path / 'oak.png'
    status, out, errors = alone('probes', file, '--water', 120, '--plot', picture)
    assert status == 0, errors
    assert picture.read_bytes().startswith(b'\x89PNG')
    assert 'solar_offset' not in out
    rows = [line.split() for line in out.splitlines() if line.strip().startswith('2013-06-')]
    assert [row[0] for row in rows] == ['2013-06-01', '2013-06-02', '2013-06-03']
    litres, low, high = float(rows[1][1]), float(rows[1][2]), float(rows[1][4])
    assert low < litres < high
    status, out, errors = alone('probes', file, '--water', 120, '--longitude', -90)
    assert status == 0, errors
    assert 'probe: {solar_offset: -6}' in out
    assert 'days of UTC-6 h' in out
    assert (litres / low, high / litres) == pytest.approx((3.2, 3.2), rel=0.1)
    status, _, errors = alone('probes', file, '--water', 120, '--species', 'cactus')
    assert status == 1
    assert 'picea_abies' in errors
