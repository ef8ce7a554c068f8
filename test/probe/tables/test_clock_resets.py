"""Clocks that began anew: only what fell to a beginning, and only until it is set."""

from __future__ import annotations

import pytest

from agv_motion.probe.tables.clock_resets import BEGINNINGS, after_reset

RIGHT = 1_370_822_400.0
OF_1990, OF_2000 = BEGINNINGS
HOUR, MONTH = 3600.0, 30 * 86400.0


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
    ],
)
def test_what_fell_to_a_beginning_is_lost_until_it_is_set(shown, lost):
    assert ''.join('.x'[each] for each in after_reset(shown)) == lost
