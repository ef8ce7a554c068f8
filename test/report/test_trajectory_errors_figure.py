"""The picture of trajectories beside their reference."""

from __future__ import annotations

import numpy as np

from agv_motion.report.stamped_poses import stamped_poses
from agv_motion.report.trajectory_errors import ComparisonRequest, Relation, compare
from agv_motion.report.trajectory_errors_figure import draw as draw_trajectory_errors


def test_trajectories_beside_their_reference(sketched, tmp_path):
    """One errs by 3 cm, the other by 50 cm."""
    angle = np.linspace(0.0, 3.0, 200)
    places = np.stack([4 * np.sin(angle), 4 * np.cos(angle), 0 * angle], axis=1)
    stamps, turns = np.arange(200) * 10**8, np.tile([0.0, 0.0, 0.0, 1.0], (200, 1))
    told = [
        stamped_poses('/pose', 'map', stamps, places + np.array([0.0, error, 0.0]), turns)
        for error in (0.0, 0.03, 0.5)
    ]
    request = ComparisonRequest(relations=tuple(Relation))
    judged = [(f'run{i} /pose', compare(told[0], told[i], request)) for i in (1, 2)]
    draw_trajectory_errors(judged, tmp_path / 'errors.png', theme='dark')
    sketched.check()
    texts = [text for text, _ in sketched[-1][1]]
    best = 'Best of 2: run1 /pose, translation errs 0.03 m (root mean square)'
    assert {best, 'reference', 'run1 /pose', 'run2 /pose', 'Error of rotation [°]'} <= set(texts)
