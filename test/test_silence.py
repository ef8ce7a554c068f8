"""Every input lost in every way: the wheels stand within its limit and one period (short form)."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

import endurance_silence as script


@pytest.mark.parametrize('name', script.CASES)
def test_no_wheel_turns_longer_than_the_limit_of_the_input_and_one_period(name):
    _, excess = script.longest(name, trials=len(script.WAYS))
    assert excess <= 1e-6
