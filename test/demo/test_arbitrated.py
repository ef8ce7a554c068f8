"""The arbiter of a demo: what is recorded of it, and that a STOP of an earlier demo is told."""

from __future__ import annotations

from typing import NamedTuple

import pytest

pytest.importorskip('rclpy')

from agv_motion.arbitration import HeldStop, Hold
from agv_motion.arbitration.hold_file import save
from agv_motion.arbitration.source import RANKED
from agv_motion.demo import differential, omni, tree, trees
from agv_motion.demo.arbitrated import held
from agv_motion.nodes.arbiter import ArbiterNode
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode

WANTED = {'cmd_vel', 'driver', 'standstill', *(f'cmd_vel/{source.value}' for source in RANKED)}


@pytest.mark.parametrize(
    'topics', [differential.TOPICS, omni.TOPICS, tree.TOPICS, trees.OF_EACH],
    ids=['differential', 'omni', 'tree', 'trees'],
)  # fmt: skip
def test_every_demo_records_who_drives_and_all_who_ask(topics):
    assert {name for name, *_ in topics} >= WANTED


class Named(NamedTuple):
    """What a demo knows of a node."""

    plain: ArbiterNode

    def get_fully_qualified_name(self):
        return '/oak/arbiter'


def test_a_stop_of_an_earlier_demo_is_told_with_its_remedy(tmp_path):
    path = tmp_path / 'arbiter.json'
    graph = InProcessGraph(lambda *_: None, 0)
    given = {'state_file': str(path)}
    free = InProcessNode(graph, ArbiterNode, given)
    save(path, Hold(HeldStop('asked for', 0.0)))
    stopped = InProcessNode(graph, ArbiterNode, given)
    (told,) = held([Named(free.plain), Named(stopped.plain)])
    assert told == (
        'STOP holds: asked for, since 1970-01-01 00:00:00: release it by /oak/arbiter/stop with '
        f'data: false, or delete {path} before the demo'
    )
