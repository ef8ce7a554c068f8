"""The walk of a tree, read back from its bag."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import Vector3, Vector3Stamped

from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.motion.navigation.zone import Zone
from agv_motion.report.walk import WalkOutcome, read_walk, summary
from agv_motion.report.walk_figure import WalkLimits, draw
from agv_motion.ros.cdr import codec


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


@pytest.mark.parametrize(
    ('litres', 'told'),
    [
        ([], []),
        ([3.0, 4.0], [('drank today', '4.00 L (2.00 to 8.00), with 95 % confidence')]),
        (
            [3.0, 4.0, 0.0, 5.0],
            [
                ('drank today', '5.0 L (2.5 to 10.0), with 95 % confidence'),
                ('drank in all', '6.0 L (3.0 to 12.0), with 95 % confidence'),
            ],
        ),
    ],
)
def test_what_it_drank_is_told_where_somebody_told_it(tmp_path, litres, told):
    with BagWriter(tmp_path / 'bag') as bag:
        kind = 'geometry_msgs/msg/Vector3Stamped'
        handle = bag.add_topic('/granier/water_use_today', kind)
        bag.add_topic('/goal', 'geometry_msgs/msg/PoseStamped')
        for i, value in enumerate(litres):
            message = Vector3Stamped(vector=Vector3(x=value, y=value / 2.0, z=2.0 * value))
            bag.write(handle, i * 1_000_000_000, codec(Vector3Stamped).encode(message))
    with BagReader(tmp_path / 'bag') as bag:
        run = read_walk(bag, 0.1)
    assert (run.water is None) == (not litres)
    zone = Zone([[0, 0], [4, 0], [4, 3], [0, 3]])
    table = summary(run, WalkOutcome(0.0, 0.0, np.empty(0), {}), zone, 0.02)
    names, texts = (list(column.cells) for column in table.columns)
    found = [row for row in zip(names, texts, strict=True) if row[0].startswith('drank')]
    assert found == told
