"""Figures of a drive: odometry laid into the map, and a drive without a pose."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.report.localization import LocalizationRun, summary
from agv_motion.report.localization_figure import draw
from agv_motion.report.stamped_columns import PoseColumns


def columns(pose):
    pose = np.array(pose, dtype=float)
    return PoseColumns(np.arange(pose.shape[1], dtype=float), pose, np.zeros((6, pose.shape[1])))


def test_odometry_is_laid_where_the_truth_begins():
    """Hand calculation: odometry goes 1 m along its x, the truth looked along y."""
    truth = columns([[5.0, 5.0], [1.0, 2.0], [np.pi / 2, np.pi / 2]])
    odom = columns([[3.0, 4.0], [3.0, 3.0], [0.0, 0.1]])
    run = LocalizationRun(truth, truth, truth, odom)
    assert run.odometry_alone().pose[:, 1] == pytest.approx([5.0, 2.0, np.pi / 2 + 0.1])
    assert run.error(run.odometry_alone())[:, 1] == pytest.approx([0.0, 0.0, 0.1], abs=1e-12)


def test_a_drive_of_which_no_pose_was_told_is_reported_and_drawn_all_the_same(tmp_path):
    truth = columns([[0.0, 1.0], [0.0, 0.0], [0.0, 0.0]])
    fix = columns([[0.1, 1.1], [0.0, 0.1], [0.02, 0.01]])
    run = LocalizationRun(truth, columns(np.empty((3, 0))), fix, fix)
    assert 'never told: position or heading was not known' in list(summary(run).columns[1].cells)
    draw(run, tmp_path / 'path.png')
    assert (tmp_path / 'path.png').stat().st_size > 10_000
