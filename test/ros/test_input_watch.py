"""What a node says of an input that falls silent: what happens next, and when."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from agv_motion.ros.input_watch import Freshness, InputWatch
from agv_motion.watchdog import Silence


class Wheels:
    """A port that keeps what is logged, at a time that the test tells."""

    def __init__(self):
        self.now, self.told = 100.0, []
        self.clock = SimpleNamespace(fault='')
        self.info = self.warning = self.error = self.told.append

    def steady_seconds(self):
        return self.now

    def watch_over(self, watch):
        """Nobody looks by himself here."""


@pytest.mark.parametrize(
    ('given', 'late', 'lost'),
    [
        (
            {'loss': 'the wheels stop'},
            'no cmd_vel for 3.0 s: the wheels stop in 2.0 s unless one comes',
            'no cmd_vel for 5.5 s: stopping',
        ),
        (
            {'remedy': 'look at it'},
            'no cmd_vel for 3.0 s: taken for lost in 2.0 s unless one comes',
            'no cmd_vel for 5.5 s: stopping; look at it',
        ),
    ],
)
def test_silence_by_hand(given, late, lost):
    port = Wheels()
    watch = InputWatch(port, 'cmd_vel', Freshness(3.0, 5.0, 5.0), **given)
    watch.note()
    assert watch.tell() is Silence.FRESH
    port.now += 3.0
    assert watch.tell() is Silence.LATE
    port.now += 2.5
    assert watch.tell() is Silence.LOST
    watch.tell()
    assert port.told == [late, lost]
    watch.note()
    port.now += 0.1
    watch.tell()
    assert port.told[2:] == ['cmd_vel is back after 5.5 s: used again']
