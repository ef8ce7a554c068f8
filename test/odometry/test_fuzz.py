"""Any numbers are taken or refused; launch_scripts/fuzz_odometry.py is the long form."""

from __future__ import annotations

import importlib.util
from pathlib import Path


def test_odometries_and_fusion_live_through_any_numbers():
    path = Path(__file__).parents[2] / 'launch_scripts' / 'fuzz_odometry.py'
    spec = importlib.util.spec_from_file_location('fuzz_odometry', path)
    fuzz_odometry = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(fuzz_odometry)
    assert fuzz_odometry.fuzz(10_000, seed=7) >= 10_000
