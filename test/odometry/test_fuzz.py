"""Any numbers are taken or refused; launch_scripts/fuzz/fuzz_odometry.py is the long form."""

from __future__ import annotations

import fuzz_odometry


def test_odometries_and_fusion_live_through_any_numbers():
    assert fuzz_odometry.fuzz(5_000, seed=7) >= 5_000
