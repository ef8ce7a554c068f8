"""The controls of a playback, as the thread that plays sees them."""

from __future__ import annotations

import threading

from agv_motion.bag.playback.transport import Transport

SECOND = 10**9


def test_what_is_overdue_goes_at_once_and_is_told_late():
    transport = Transport(SECOND, 1.0)
    transport.resume()
    assert transport.wait_until_due(0)
    assert transport.lag.count == 1


def test_a_single_message_goes_though_it_stands_and_takes_the_time_with_it():
    transport = Transport(0, 1.0)
    transport.play_next(1)
    assert transport.wait_until_due(5 * SECOND)
    assert transport.position() == 5 * SECOND
    assert transport.lag.count == 0


def test_who_is_sent_elsewhere_or_stopped_waits_no_more():
    transport, finished = Transport(0, 1.0), threading.Event()
    finished.set()
    transport.seek(7 * SECOND, finished)
    assert not transport.wait_until_due(0)
    assert not finished.is_set()
    assert (transport.take_goal(), transport.take_goal()) == (7 * SECOND, None)
    transport.stop()
    assert not transport.wait_until_due(0)
    finished.set()
    transport.seek(SECOND, finished)
    assert finished.is_set()


def test_at_the_end_single_messages_are_forgotten_unless_it_was_sent_elsewhere():
    transport, finished = Transport(0, 1.0), threading.Event()
    transport.play_next(3)
    transport.seek(0, finished)
    transport.wait_at_end(finished)
    assert not finished.is_set()
    transport.take_goal()
    assert transport.wait_until_due(SECOND)  # one of the three
    transport.stop()
    transport.wait_at_end(finished)
    assert finished.is_set()
