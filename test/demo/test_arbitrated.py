"""The arbiter of a demo: what is recorded of it."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from agv_motion.arbitration.source import RANKED
from agv_motion.demo import differential, omni, tree, trees

WANTED = {'cmd_vel', 'driver', 'standstill', *(f'cmd_vel/{source.value}' for source in RANKED)}


@pytest.mark.parametrize(
    'topics', [differential.TOPICS, omni.TOPICS, tree.TOPICS, trees.OF_EACH],
    ids=['differential', 'omni', 'tree', 'trees'],
)  # fmt: skip
def test_every_demo_records_who_drives_and_all_who_ask(topics):
    assert {name for name, *_ in topics} >= WANTED
