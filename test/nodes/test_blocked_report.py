"""A robot that is blocked: told once, and once more when it tries again."""

from __future__ import annotations

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
    log = []
    port = SimpleNamespace(
        error=log.append, info=log.append, full_name=lambda topic: f'/oak/{topic}'
    )
    report = BlockedReport(port, NEVER, 0.2, 'clear its way')
    assert not any(report.look(NEVER, HERE, FAST, 0.1) for _ in range(100))
    found = [report.look(SOON, HERE, FAST, 0.1) for _ in range(50)]
    assert sum(found) == 2
    assert log[0].startswith('blocked: told to move by')
    assert log[1] == 'blocked before: trying again'
    assert log[2] == report.reason == log[0]
    assert len(log) == 3
