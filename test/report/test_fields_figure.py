"""The picture of fields over time."""

from __future__ import annotations

import numpy as np

from agv_motion.report.fields_figure import FieldLine
from agv_motion.report.fields_figure import draw as draw_fields


def test_fields_of_a_bag_with_notes(sketched, tmp_path):
    time = np.linspace(0.0, 100.0, 50)
    many = [FieldLine(f'/turrets/state position[{i}]', time, time + i) for i in range(12)]
    few = [FieldLine(f'/odom twist.linear.{axis}', time, time) for axis in 'xyz']
    notes = [
        (10.0, 'rain began'),
        (10.5, 'somebody opened the gate and left it open'),
        (99.9, 'end'),
    ]
    draw_fields([few, many], tmp_path / 'bag.png', notes)
    sketched.check()
    texts = {text for text, _ in sketched[-1][1]}
    assert {'/odom', 'twist.linear.x', '/turrets/state', 'position[11]', 'rain began'} <= texts
    assert 'somebody opened the gate and left it op…' in texts
