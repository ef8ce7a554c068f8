"""Days of water are those of the place, wherever that is."""

from __future__ import annotations

import pytest

from agv_motion.cli.probe.water_days import tell_water, water_days
from agv_motion.probe.parameters import ProbeParameters
from agv_motion.probe.tables.description import describe
from agv_motion.probe.tables.table import read_tables
from agv_motion.probe.tables.table_parameters import TableParameters
from agv_motion.probe.water import DAY

MIDNIGHT = 1_370_822_400
"""[s] since 1970: the tenth of June 2013"""


@pytest.fixture
def found_at(tmp_path):
    """Return what describes three days of a tree whose solar time is ahead of UTC by some hours."""

    def found(hours):
        file = tmp_path / 'oak.csv'
        rows = (
            f'{MIDNIGHT + 900 * k - int(3600 * hours)},'
            f'{0.8 - 0.05 * max(0.0, 1.0 - abs(k % 96 - 56) / 24.0) + 1e-4 * (k % 3):.5f}\n'
            for k in range(3 * 96)
        )
        file.write_text('time,probe_1\n' + ''.join(rows))
        given = TableParameters(file=str(file), columns=('probe_1',))
        return describe(read_tables(given), given.columns)

    return found


@pytest.mark.parametrize('hours', [-8.0, 5.5, 12.0])
def test_a_tree_drinks_the_same_at_any_longitude(found_at, hours):
    at_greenwich = water_days(found_at(0.0), 25.0, ProbeParameters(), 120.0)
    there = water_days(found_at(hours), 25.0, ProbeParameters(solar_offset=hours), 120.0)
    assert [day.day - MIDNIGHT // DAY for day in there] == [0, 1, 2]
    for one, other in zip(at_greenwich, there, strict=True):
        assert other.drunk == pytest.approx(one.drunk, rel=1e-9)
        assert other.known == pytest.approx(one.known)
    assert there[1].drunk.value > 0.1
    wrong = water_days(found_at(hours), 25.0, ProbeParameters(), 120.0)
    assert [day.known for day in wrong] != pytest.approx([day.known for day in there])


def test_what_is_printed_names_its_days(found_at, capsys):
    tell_water(found_at(5.5), 25.0, ProbeParameters(solar_offset=5.5), 120.0)
    told = capsys.readouterr().out
    assert 'Water through 120 cm2 of sapwood, calibration granier, days of UTC+5.5 h:' in told
    assert [f'2013-06-{day}' in told for day in (9, 10, 11, 12, 13)] == [
        False, True, True, True, False
    ]  # fmt: skip
