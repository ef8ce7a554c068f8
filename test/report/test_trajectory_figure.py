"""The picture of a plan."""

from __future__ import annotations

import numpy as np

from agv_motion.planar import Pose
from agv_motion.report.trajectory_figure import draw as draw_plan
from agv_motion.trajectory.ghost import Ghost
from agv_motion.trajectory.ghost_parameters import GhostParameters


def test_a_plan(sketched, tmp_path):
    limits = GhostParameters()
    ghost = Ghost(Pose(0.0, 0.0, 0.0), limits)
    trajectory = ghost.compute_trajectory(Pose(2.0, 1.0, np.pi / 2), 0.5, 0.4, 0.4)
    draw_plan(trajectory, limits, tmp_path / 'plan.png')
    sketched.check()
    texts = {text for text, _ in sketched[-1][1]}
    assert {'start', 'end', 'left wheel', 'right wheel'} <= texts
