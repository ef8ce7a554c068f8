"""A robot that is blocked: told once, and once more when it tries again."""

from __future__ import annotations

from itertools import count
from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from agv_motion.blocked import AfterBlock, BlockedParameters
from agv_motion.nodes.blocked_report import BlockedReport
from agv_motion.planar import Pose, Twist

HERE, FAST = Pose(0.0, 0.0, 0.0), Twist(1.0, 0.0, 0.0)
NEVER = BlockedParameters(after=0.0)
SOON = BlockedParameters(after=1.0, then=AfterBlock.RETRY.value, retry_after=2.0)


def test_it_is_told_when_it_begins_and_when_it_tries_again():
    log, clock = [], count()
    port = SimpleNamespace(
        error=log.append, info=log.append, full_name=lambda topic: f'/oak/{topic}',
        seconds=lambda: 0.1 * next(clock),
    )  # fmt: skip
    report = BlockedReport(port, NEVER, 0.2, 'clear its way', 1.0)
    assert not any(report.look(NEVER, HERE, FAST) for _ in range(100))
    found = [report.look(SOON, HERE, FAST) for _ in range(50)]
    assert sum(found) == 2
    assert log[0].startswith('blocked: told to move by')
    assert log[1] == 'blocked before: trying again'
    assert log[2] == report.reason == log[0]
    assert len(log) == 3


def test_time_in_which_nobody_has_looked_counts_little_and_none_where_the_clock_goes_back():
    times = iter([0.0, 50.0, 51.0, 20.0, 21.0])
    port = SimpleNamespace(
        error=print, full_name=lambda topic: f'/oak/{topic}', seconds=lambda: next(times)
    )
    report = BlockedReport(port, SOON, 0.2, 'clear its way', 0.45)
    assert [report.look(SOON, HERE, FAST) for _ in range(4)] == [False, False, False, True]
