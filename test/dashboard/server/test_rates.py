"""So many at once, then so many a second, each key by itself."""

from __future__ import annotations

from agv_motion.dashboard.server.rates import RateLimit


def test_a_burst_is_allowed_and_then_the_rate():
    now = [0.0]
    limit = RateLimit(3.0, 0.5, lambda: now[0])
    assert [limit.allows('a') for _ in range(5)] == [True, True, True, False, False]
    assert limit.allows('b')
    now[0] = 1.9
    assert not limit.allows('a')
    now[0] = 2.1
    assert [limit.allows('a'), limit.allows('a')] == [True, False]


def test_a_long_rest_fills_no_more_than_the_burst_and_a_dear_act_costs_more():
    now = [0.0]
    limit = RateLimit(3.0, 0.5, lambda: now[0])
    limit.allows('a')
    now[0] = 1e6
    assert [limit.allows('a', 2.0), limit.allows('a', 2.0), limit.allows('a')] == [
        True,
        False,
        True,
    ]
