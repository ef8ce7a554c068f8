"""Times and ages in words."""

from __future__ import annotations

import pytest

from agv_motion.explanation.words import ago, clock


@pytest.mark.parametrize(
    ('seconds', 'words'),
    [(0.34, '0.3 s'), (12.4, '12 s'), (119.0, '119 s'), (600.0, '10 min'), (7500.0, '2 h 05 min'),
     (200_000.0, '2 days')],
)  # fmt: skip
def test_a_span_of_time(seconds, words):
    assert ago(seconds) == words


NOON = 1434369600.0


def test_a_moment_in_local_time_with_its_date_where_that_is_another():
    assert clock(NOON, NOON, 'Europe/Paris') == '14:00'
    assert clock(NOON - 86400.0, NOON) == '2015-06-14 12:00'
    assert not clock(None, NOON)
    assert clock(NOON, NOON, 'No/Where') == '12:00'
    assert not clock(1e30, NOON)
