"""The picture of a robot that drives: a few lines, always as many."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from agv_motion.demo.drive_view import DriveView

SIZES = [(80, 24), (200, 50)]


@pytest.mark.parametrize(('columns', 'rows'), SIZES)
def test_a_robot_that_drives(columns, rows, heard, shown):
    view = DriveView(heard, {'odom': 'odom'}, 'state')
    before = shown(view, 0.0, columns, rows)
    heard.hear_tree()
    after = shown(view, 1.0, columns, rows)
    assert len(before) == len(after) == 4
    assert max(map(len, after)) <= columns
    assert 'odom     7.25   5.50 m    0°' in '\n'.join(after)
    assert '-0' not in '\n'.join(after)
