"""Commands that are ended while they write; launch_scripts/trials/trial_kills.py is the long form.

Each is ended at the same changes of files in every run, however fast the machine is: by kill -9,
Ctrl-C, SIGTERM and a full disk.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

TRIAL = Path(__file__).parents[1] / 'launch_scripts' / 'trials' / 'trial_kills.py'


def test_nothing_half_is_left_nothing_is_gone_and_a_rerun_completes():
    asked = ['--by', 'change', '--moments', '2', '--only', 'bag recover', 'bag index', 'calibrate']
    done = subprocess.run(  # noqa: S603 - our own command
        [sys.executable, str(TRIAL), *asked],
        capture_output=True,
        text=True,
        timeout=200,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.count(': 0 wrong') == 3
