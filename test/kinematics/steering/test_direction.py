"""Directions of a twist: what each wheel does."""

from __future__ import annotations

from math import cos, pi, sin

import pytest

from agv_motion.kinematics.steering.direction import are_near, bearings, wheel_lengths

ARMS = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0)]


def test_wheels_of_a_rotation_move_square_to_their_arms():
    assert bearings(ARMS, (0.0, 0.0, 1.0)) == pytest.approx([pi / 2, -pi / 2, pi])
    assert wheel_lengths(ARMS, (0.0, 0.0, 0.5)) == pytest.approx([0.5] * 3)


def test_a_wheel_at_the_centre_of_rotation_has_no_bearing():
    assert bearings(ARMS, (0.0, 0.6, 0.6)) == [
        pytest.approx(pi / 2),
        None,
        pytest.approx(3 * pi / 4),
    ]
    assert wheel_lengths(ARMS, (0.3, 0.4, 0.2)) == pytest.approx([0.45**0.5, 0.13**0.5, 0.17**0.5])


@pytest.mark.parametrize(('off', 'near'), [(0.0, True), (0.169, True), (0.171, False), (pi, False)])
def test_near_is_within_the_start_error(off, near):
    for turned in ((cos(off), sin(off), 0.0), (cos(off), 0.0, -sin(off))):
        assert are_near((1.0, 0.0, 0.0), turned) == are_near(turned, (1.0, 0.0, 0.0)) == near
    assert are_near((0.0, 1.0, 0.0), (0.0, cos(off), sin(off))) == near
