"""Who tells the simulated time, and who else does."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from agv_motion.nodes.clock_leader import ClockLeader


def test_all_who_tell_the_time_are_named_with_what_to_do():
    told, timers, clocks = [], {}, ['']
    port = SimpleNamespace(
        publisher=lambda _, topic, __: SimpleNamespace(publish=lambda m: told.append((topic, m))),
        every=lambda seconds, act, *, steady: timers.update({(seconds, steady): act}),
        crowd=lambda topic: clocks[0] if topic == '/clock' else '',
        error=lambda text, **_: told.append(text),
    )
    leader = ClockLeader(port, 0.02, lambda: told.append('led'))
    timers[0.02, True]()
    leader.tell(3_000_000_007)
    [led, (topic, message)] = told
    assert (led, topic, message.clock.sec, message.clock.nanosec) == ('led', '/clock', 3, 7)
    told.clear()
    timers[1.0, True]()
    assert (told, leader.rivals) == ([], '')
    clocks[0] = '/ash/simulator, /rosbag2_player'
    timers[1.0, True]()
    [text] = told
    assert text.startswith('/ash/simulator, /rosbag2_player all tell the time on /clock')
    assert 'clock: follow' in text
    clocks[0] = ''
    timers[1.0, True]()
    assert leader.rivals == ''
