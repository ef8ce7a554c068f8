"""Every input lost in every way: the wheels stand within its limit and one period (short form)."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

SCRIPT = Path(__file__).parents[1] / 'launch_scripts' / 'endurance_silence.py'
spec = importlib.util.spec_from_file_location('endurance_silence', SCRIPT)
script = sys.modules['endurance_silence'] = importlib.util.module_from_spec(spec)
spec.loader.exec_module(script)


@pytest.mark.parametrize('name', script.CASES)
def test_no_wheel_turns_longer_than_the_limit_of_the_input_and_one_period(name):
    _, excess = script.longest(name, trials=len(script.WAYS))
    assert excess <= 1e-6
