"""Clocks that began anew: only what fell to a beginning, and only until it is set."""

from __future__ import annotations

import pytest

from agv_motion.probe.tables.clock_resets import BEGINNINGS, after_reset

RIGHT = 1_370_822_400.0
OF_1990, OF_2000 = BEGINNINGS
HOUR, DAY = 3600.0, 86400.0
MONTH = 30 * DAY


def test_clocks_begin_with_1990_and_2000():
    assert BEGINNINGS == (631_152_000.0, 946_684_800.0)


@pytest.mark.parametrize(
    ('shown', 'lost'),
    [
        ([], ''),
        ([RIGHT, RIGHT + HOUR], '..'),
        ([RIGHT, OF_2000, OF_2000 + HOUR, RIGHT + HOUR], '.xx.'),
        ([RIGHT, OF_1990 + HOUR, RIGHT - HOUR, RIGHT], '.xx.'),  # set late: beyond where it fell
        ([RIGHT, OF_1990, OF_1990 + 2 * MONTH], '.xx'),  # never set
        ([OF_2000, OF_2000 + HOUR, RIGHT, RIGHT + HOUR], 'xx..'),  # begins so
        ([OF_2000, OF_2000 + HOUR], '..'),  # may be of 2000 indeed
        ([RIGHT, RIGHT - MONTH, RIGHT + HOUR], '...'),  # only out of order
        ([RIGHT, OF_2000 + 2 * MONTH, RIGHT + HOUR], '...'),  # two years, the later first
        ([OF_2000 + MONTH, OF_2000, OF_2000 + HOUR], '...'),
        ([OF_2000 + 366 * DAY, OF_2000, OF_2000 + HOUR], '.xx'),
        ([OF_2000 + 365 * DAY, OF_2000, OF_2000 + HOUR], '...'),  # no more than a year
        ([RIGHT, OF_2000 + DAY - 1.0, RIGHT], '.x.'),
        ([RIGHT, OF_2000 + DAY, RIGHT], '...'),  # that of 2000 is a day long
        ([RIGHT, OF_2000 - 1.0, RIGHT], '...'),
        ([OF_2000, OF_2000 + 366 * DAY], 'x.'),
        ([OF_2000, OF_2000 + 365 * DAY], '..'),
        ([OF_2000 + DAY, RIGHT], '..'),
        ([OF_1990], '.'),
        ([OF_2000, OF_2000 + HOUR, RIGHT, OF_2000, RIGHT + HOUR], 'xx.x.'),
    ],
)
def test_what_fell_to_a_beginning_is_lost_until_it_is_set(shown, lost):
    assert ''.join('.x'[each] for each in after_reset(shown)) == lost
