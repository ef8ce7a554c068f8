"""`agv demo omni`: a short drive, its figure, and figures that are what its bag says."""

from __future__ import annotations

import re

import numpy as np
import pytest

pytest.importorskip('rclpy')

from agv_motion.bag.reader import BagReader
from agv_motion.errors import ConfigurationError
from agv_motion.report.localization import read_localization
from agv_motion.report.stamped_columns import pose_columns


def test_a_short_drive_leaves_a_bag_and_a_figure(terminal, tmp_path):
    screen = terminal(
        'demo', 'omni', '--minutes', 0.2, '--time-factor', 15, '--no-carry',
        '--no-page', '--output', tmp_path,
    )  # fmt: skip
    screen.wait(lambda text: 'm/s forward' in text)
    status, out = screen.end()
    assert status == 0, out
    screen.frames()
    assert (tmp_path / 'path.png').stat().st_size > 10_000
    with BagReader(tmp_path / 'bag') as bag:
        run = read_localization(bag)
        with pytest.raises(ConfigurationError, match=r"no topic '/pos'; did you mean '/pose'\?"):
            pose_columns(bag, ['/pos'])
    told = np.hypot(*run.error(run.pose)[:2])
    assert np.median(told) < 0.15
    assert re.search(r'errs +\d+\.\d cm', out)
