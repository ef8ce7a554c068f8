"""Messages by their arrival on the wall, stamped with the simulated time."""

from __future__ import annotations

from struct import pack

import pytest

pytest.importorskip('rclpy')

from agv_motion.ros.arrivals import TICK, Arrivals


def tick(seconds, rest=0, order='<'):
    return (b'\0\1\0\0' if order == '<' else b'\0\0\0\0') + pack(f'{order}iI', seconds, rest)


def info(received, number=0):
    return {'received_timestamp': received, 'publication_sequence_number': number}


@pytest.fixture
def put():
    return []


@pytest.fixture
def arrivals(put):
    return Arrivals(lambda *told: put.append(told), 5)


def test_each_gets_the_time_of_the_last_tick_before_it(arrivals, put):
    """They are taken topic by topic, so that the tick is taken last."""
    arrivals.add(3, b'c', info(30))
    arrivals.add(1, b'a', info(10, 7))
    arrivals.add(2, b'b', info(25))
    arrivals.add(TICK, tick(2, 9), info(20))
    arrivals.pass_on()
    now = 2_000_000_009
    assert put == [(1, 5, b'a', 5, 7), (2, now, b'b', now, 0), (3, now, b'c', now, 0)]
    assert arrivals.now == now


def test_what_may_be_overtaken_waits(arrivals, put):
    arrivals.add(1, b'a', info(10))
    arrivals.add(1, b'b', info(30))
    arrivals.pass_on(20)
    assert [told[2] for told in put] == [b'a']
    arrivals.add(TICK, tick(1, order='>'), info(25))
    arrivals.pass_on(40)
    assert put[1] == (1, 10**9, b'b', 10**9, 0)


def test_a_time_before_all_times_is_none(arrivals):
    arrivals.add(TICK, tick(-3), info(1))
    arrivals.pass_on()
    assert arrivals.now == 0
