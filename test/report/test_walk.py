"""The walk of a tree, read back from its bag."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip('rclpy')

from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.motion.navigation.zone import Zone
from agv_motion.report.walk import WalkOutcome, read_walk, summary
from agv_motion.report.walk_figure import WalkLimits, draw


def test_a_walk_of_which_nothing_was_recorded_is_told_and_drawn_all_the_same(tmp_path):
    with BagWriter(tmp_path / 'bag') as bag:
        bag.add_topic('/goal', 'geometry_msgs/msg/PoseStamped')
    with BagReader(tmp_path / 'bag') as bag:
        run = read_walk(bag, 0.1)
    zone = Zone([[0, 0], [4, 0], [4, 3], [0, 3]])
    assert run.distance() == 0.0
    outcome = WalkOutcome(0.0, 0.0, np.empty(0), {})
    assert summary(run, outcome, zone, 0.02).row_count > 4
    draw(run, zone, WalkLimits(0.02), tmp_path / 'walk.png')
    assert (tmp_path / 'walk.png').stat().st_size > 10_000
