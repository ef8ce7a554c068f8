"""What is told of a file, and the parameters that read it."""

from __future__ import annotations

from math import isnan, nan
from types import SimpleNamespace

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.probe.tables import TableParameters, read_tables
from agv_motion.probe.tables.description import asked_for, describe, parameters_for, unit_in
from agv_motion.probe.tables.inspection import inspect


def described(tmp_path, text, **known):
    file = tmp_path / 'a.csv'
    file.write_text(text)
    seen = inspect(str(file))
    given = parameters_for(seen, {'file': str(file)} | known, ())
    return given, describe(read_tables(given), given.columns)


def test_rows_gaps_and_columns(tmp_path):
    rows = ''.join(f'2013-06-10 {hour:02}:00,{hour + 5.0},\n' for hour in (0, 1, 2, 5, 6, 7))
    _, found = described(tmp_path, 'time,probe_1,probe_2\n' + rows)
    assert found.step == 3600.0
    assert [end - begin for begin, end in found.gaps] == [3 * 3600.0]
    assert found.columns[0][1:] == (6, 0, 5.0, 12.0, 'K')


def test_one_row_has_no_step(tmp_path):
    _, found = described(tmp_path, 'time,probe_1\n2013-06-10 00:00,0.5\n')
    assert isnan(found.step)
    assert found.gaps == ()
    assert found.columns[0].like == 'mV'


@pytest.mark.parametrize(
    ('usual', 'like'),
    [
        (0.049, ''), (0.05, 'mV'), (2.49, 'mV'), (2.5, 'K'), (29.9, 'K'), (30.0, ''), (nan, ''),
    ],
)  # fmt: skip
def test_what_is_usual_in_a_column_tells_its_unit(usual, like):
    """A thermocouple of type T tells 0.05 to 2.5 mV, which are 1 to 60 K; kelvin go from 2.5."""
    values = np.array([[usual], [usual], [9999.0 if like else usual]])
    (found,) = describe(SimpleNamespace(times=np.arange(3.0), values=values), ['a']).columns
    assert found.like == like
    assert (found.values, found.missing) == ((0, 3) if isnan(usual) else (3, 0))


def test_more_than_one_and_a_half_steps_are_a_gap():
    times = np.array([0.0, 10.0, 25.0, 40.1, 50.0, 60.0, 70.0])
    found = describe(SimpleNamespace(times=times, values=np.zeros((7, 0))), [])
    assert found.step == 10.0
    assert found.gaps == ((25.0, 40.1),)


@pytest.mark.parametrize(
    ('name', 'unit'),
    [
        ('delta_v_mv', 'mV'),
        ('dT [K]', 'K'),
        ('T (°C)', 'K'),
        ('a_uV', 'uV'),
        ('probe', ''),
        ('k', ''),
    ],
)  # fmt: skip
def test_units_in_names(name, unit):
    assert unit_in(name) == unit


def test_only_what_has_to_be_written_is_asked_for(tmp_path):
    given, _ = described(tmp_path, 'time,probe_1\n2013-06-10 00:00,0.5\n')
    assert asked_for(given) == {'file': given.file, 'columns': ('probe_1',)}
    given, _ = described(tmp_path, '2013-06-10 00:00;0,5\n2013-06-10 01:00;0,6\n')
    assert asked_for(given) | {'file': ''} == {
        'file': '', 'time_column': '1', 'columns': ('2',), 'delimiter': 'semicolon',
    }  # fmt: skip
    named = TableParameters(time_column='time', columns=('2', 'b'), delimiter='semicolon')
    assert 'delimiter' not in asked_for(named)  # one name is enough to find it


@pytest.mark.parametrize(
    ('text', 'match'),
    [
        (
            'time,probe_1\n06/10/2013,0.5\n',
            r"'06/10/2013'.*day_first or month_first.*--time-format",
        ),
        ('a,b\nx,0.5\n', 'no column of time is seen'),
        ('time,b\n2013-06-10,x\n', 'no column of numbers is seen'),
    ],
)
def test_what_cannot_be_seen_is_asked_for(tmp_path, text, match):
    with pytest.raises(ConfigurationError, match=match):
        described(tmp_path, text)


def test_what_is_known_better_counts(tmp_path):
    given, _ = described(tmp_path, 'time,probe_1\n06/10/2013,0.5\n', time_format='month_first')
    assert given.time_format == 'month_first'
    assert isinstance(given, TableParameters)
