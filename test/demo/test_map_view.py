"""The map takes the room that there is beside the numbers, and gives way where there is none."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from agv_motion.demo.tree_view import TreeView
from agv_motion.nodes.simulator import SimulatorParameters


def test_the_map_follows_the_terminal(zone, heard, shown):
    heard.hear_tree()
    view = TreeView(heard, zone, SimulatorParameters())
    assert len(shown(view, 1.0, 200, 50)) > len(shown(view, 1.0, 80, 24))
    narrow = '\n'.join(shown(view, 1.0, 40, 16))
    assert 'walking to (10.00,' in narrow
    assert '♣' not in narrow  # no room for a map
