"""Refused inputs: told, counted, and recent for a while."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from agv_motion.ros.complaints import COMPLAINT_LIFETIME, Complaints


@pytest.fixture
def stage():
    lines, clock = [], SimpleNamespace(now=100.0)
    logger = SimpleNamespace(
        warning=lambda text: lines.append(('warning', text)),
        info=lambda text: lines.append(('info', text)),
    )
    return SimpleNamespace(
        lines=lines, clock=clock, complaints=Complaints(logger, lambda: clock.now)
    )


def test_what_is_refused_is_told_counted_and_recent_for_a_while(stage):
    assert not stage.complaints.is_recent()
    stage.complaints.refuse('too fast')
    assert stage.lines == [('warning', 'refused: too fast')]
    assert (stage.complaints.count, stage.complaints.last) == (1, 'too fast')
    stage.clock.now += COMPLAINT_LIFETIME - 0.1
    assert stage.complaints.is_recent()
    stage.clock.now += 0.2
    assert not stage.complaints.is_recent()


def test_of_repeats_only_some_are_told(stage):
    for _ in range(1000):
        stage.complaints.refuse('too fast')
        stage.complaints.inform('done')
    assert stage.complaints.count == 1000
    assert 2 <= len(stage.lines) < 100
    assert ('info', 'done') in stage.lines
