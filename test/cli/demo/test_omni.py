"""`agv demo omni`: a short drive, its figure, and figures that are what its bag says."""

from __future__ import annotations

import re

import numpy as np
import pytest

pytest.importorskip('rclpy')

from agv_motion.bag.reader import BagReader
from agv_motion.errors import ConfigurationError
from agv_motion.report.localization import LocalizationRun, draw, read_localization, summary
from agv_motion.report.stamped_columns import PoseColumns, pose_columns


def test_a_short_drive_leaves_a_bag_and_a_figure(alone, tmp_path):
    status, out, errors = alone(
        'demo', 'omni', '--minutes', 0.5, '--time-factor', 15, '--no-carry', '--output', tmp_path,
        timeout=60.0,
    )  # fmt: skip
    assert status == 0, errors
    assert (tmp_path / 'path.png').stat().st_size > 10_000
    with BagReader(tmp_path / 'bag') as bag:
        run = read_localization(bag)
        with pytest.raises(ConfigurationError, match=r"no topic '/pos'; did you mean '/pose'\?"):
            pose_columns(bag, ['/pos'])
    told = np.hypot(*run.error(run.pose)[:2])
    assert np.median(told) < 0.15
    assert re.search(r'errs +\d+\.\d cm', out)


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
