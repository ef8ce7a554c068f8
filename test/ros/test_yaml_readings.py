"""What YAML 1.1 made of a text or number is told back, where that is unmistakable."""

from __future__ import annotations

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.parameters import TIME_OF_DAY
from agv_motion.ros.yaml_readings import as_written

LIST = tuple[float, ...]


@pytest.mark.parametrize(
    ('value', 'wanted', 'unit', 'present', 'written'),
    [
        (600, str, TIME_OF_DAY, '08:00', '10:00'),
        (0, str, TIME_OF_DAY, None, '00:00'),
        (1439, str, TIME_OF_DAY, None, '23:59'),
        (1440, str, TIME_OF_DAY, None, 1440),
        (-1, str, TIME_OF_DAY, None, -1),
        (True, str, TIME_OF_DAY, None, True),
        (600, str, '', '08:00', 600),
        (True, str, '', 'on', 'on'),
        (False, str, '', 'No', 'No'),
        (12, str, '', '12', '12'),
        (12, str, '', '12.0', 12),
        (10, str, '', '0b1010', '0b1010'),
        (12.5, str, '', '12.5', '12.5'),
        ('1e-06', float, '', 1.0, 1e-6),
        ('nan', float, '', 1.0, 'nan'),
        ('inf', float, '', 1.0, 'inf'),
        ('fast', float, '', 1.0, 'fast'),
        (1, float, '', 1.0, 1),
        ('[1.0, 2e-07]', LIST, '', [], [1.0, 2e-7]),
        ('[1.0, none]', LIST, '', [], '[1.0, none]'),
        ('[1.0, nan]', LIST, '', [], '[1.0, nan]'),
        ('1e-07', LIST, '', [], '1e-07'),
        ('1', int, '', 1, '1'),
    ],
)
def test_by_hand(value, wanted, unit, present, written):
    found = as_written(value, wanted, unit, present)
    assert found == written
    assert type(found) is type(written)


@given(st.integers(0, 23), st.integers(0, 59))
def test_each_time_of_day_survives_yaml(hour, minute):
    text = f'{hour:02}:{minute:02}'
    assert as_written(yaml.safe_load(text), str, TIME_OF_DAY, None) == text


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_each_number_survives_yaml(number):
    assert as_written(yaml.safe_load(str(number)), float, '', None) == number
