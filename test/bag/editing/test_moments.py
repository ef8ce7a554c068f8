"""Moments as people write them."""

from __future__ import annotations

from datetime import datetime, timezone

import pytest

from agv_motion.bag.editing.moments import moment
from agv_motion.errors import ConfigurationError

SECOND = 10**9


def at(*parts):
    return int(datetime(*parts, tzinfo=timezone.utc).timestamp()) * SECOND


START, END = at(2024, 5, 3, 13, 50) + 123, at(2024, 5, 3, 15, 0) + 456


@pytest.mark.parametrize(('text', 'expected'), [
    ('0', START), ('90', START + 90 * SECOND), ('+1.5s', START + 1_500_000_000),
    ('0.000000001', START + 1), ('-10', END - 10 * SECOND), (' 12 ', START + 12 * SECOND),
    ('14:32', at(2024, 5, 3, 14, 32)), ('14:32:05.25', at(2024, 5, 3, 14, 32, 5) + 250_000_000),
    ('16:32+02:00', at(2024, 5, 3, 14, 32)), ('09:02 -0530', at(2024, 5, 3, 14, 32)),
    ('2024-05-03T14:32', at(2024, 5, 3, 14, 32)), ('2024-05-03 14:32:00Z', at(2024, 5, 3, 14, 32)),
    ('2024-05-03', at(2024, 5, 3)), ('2024-05', at(2024, 5, 1)),
    ('@1714746720.000000007', 1714746720 * SECOND + 7), ('23:59 UTC', at(2024, 5, 3, 23, 59)),
])  # fmt: skip
def test_what_people_write(text, expected):
    assert moment(text, START, END) == expected


def test_a_time_of_day_after_midnight_is_of_the_next_day():
    start, end = at(2024, 5, 3, 22, 0), at(2024, 5, 4, 4, 0)
    assert moment('23:00', start, end) == at(2024, 5, 3, 23, 0)
    assert moment('01:30', start, end) == at(2024, 5, 4, 1, 30)
    assert moment('01:30+02:00', start, end) == at(2024, 5, 3, 23, 30)


def test_a_time_of_day_that_no_day_of_the_bag_has_is_the_closest():
    start, end = at(2024, 5, 3, 23, 50), at(2024, 5, 4, 0, 5)
    assert moment('00:10', start, end) == at(2024, 5, 4, 0, 10)
    assert moment('23:40', start, end) == at(2024, 5, 3, 23, 40)
    start, end = at(2024, 5, 4, 0, 10), at(2024, 5, 4, 0, 30)
    assert moment('23:00', start, end) == at(2024, 5, 3, 23, 0)
    assert moment('12:00', start, at(2024, 5, 7)) == at(2024, 5, 4, 12, 0)


def test_the_day_is_that_of_the_place_that_is_named():
    start, end = at(2024, 5, 3, 23, 30), at(2024, 5, 4, 1, 0)
    assert moment('01:45+02:00', start, end) == at(2024, 5, 3, 23, 45)


@pytest.mark.parametrize('text', [
    'noon', '', 'nan', 'inf', '1e9', '25:00', '14:60', '12:00:60', '2024-13-01T00:00', '14.32.05',
    '2024-5-3', '2024-13', '2024-02-30', '@', '--5', '12:00+99:99', '1' * 40, '0x10', '@-5',
])  # fmt: skip
def test_what_is_no_moment_is_refused_with_the_forms(text):
    with pytest.raises(ConfigurationError, match='seconds after the start of the bag'):
        moment(text, START, END)


def test_nothing_lies_before_1970():
    assert moment('-100', 5 * SECOND, 9 * SECOND) == 0


def test_a_bag_of_any_year():
    assert moment('5', 2**63, 2**63) == 2**63 + 5 * SECOND
    assert moment('14:32', 2**64 - 1, 2**64 - 1) // SECOND % 86400 == (14 * 60 + 32) * 60
