"""One roller wheel: its two directions, by hand."""

from __future__ import annotations

from math import nan, pi, sqrt

import pytest

from agv_motion.errors import GeometryError
from agv_motion.kinematics.omniwheel_placement import (
    DRIVELESS,
    OmniWheel,
    mecanum_wheels,
    require_driven,
    wheels_on_circle,
)


def test_an_omni_wheel_drives_along_and_rolls_freely_across():
    """At (2, 3), rolling along x: V = vx - 3 wz, s = vy + 2 wz."""
    wheel = OmniWheel(2.0, 3.0, 0.0)
    assert wheel.driven() == pytest.approx((1.0, 0.0, -3.0), abs=1e-15)
    assert wheel.free() == pytest.approx((0.0, 1.0, 2.0), abs=1e-15)


def test_a_mecanum_wheel_adds_what_its_rollers_let_go():
    """Rollers at 45 degrees: V = vx - vy, s = sqrt(2) vy, at the origin."""
    wheel = OmniWheel(0.0, 0.0, 0.0, pi / 4)
    assert wheel.driven() == pytest.approx((1.0, -1.0, 0.0), abs=1e-15)
    assert wheel.free() == pytest.approx((0.0, sqrt(2.0), 0.0), abs=1e-15)


def test_wheels_on_a_circle_roll_clockwise():
    first, second = wheels_on_circle([0.0, pi / 2], [2.0, 1.0])
    assert first == pytest.approx((2.0, 0.0, -pi / 2, pi / 2))
    assert second == pytest.approx((0.0, 1.0, 0.0, pi / 2), abs=1e-15)
    assert first.driven() == pytest.approx((0.0, -1.0, -2.0), abs=1e-15)


def test_mecanum_wheels_stand_at_the_corners_and_their_rollers_meet_in_an_x():
    q = pi / 4
    assert mecanum_wheels(0.3, 0.2) == [
        (0.3, 0.2, 0.0, q),
        (0.3, -0.2, 0.0, -q),
        (-0.3, 0.2, 0.0, -q),
        (-0.3, -0.2, 0.0, q),
    ]


@pytest.mark.parametrize('slide', [0.0, pi, -pi, 0.5 * DRIVELESS])
def test_a_wheel_that_slides_along_its_rolling_direction_drives_nothing(slide):
    with pytest.raises(GeometryError, match='wheel 3 slides along its own rolling direction'):
        require_driven(3, OmniWheel(1.0, 0.0, 0.0, slide))


@pytest.mark.parametrize('slide', [1.5e-6, -1.5e-6, pi - 1.5e-6])
def test_a_wheel_that_slides_hardly_beside_it_drives(slide):
    require_driven(3, OmniWheel(1.0, 0.0, 0.0, slide))
    require_driven(3, OmniWheel(1.0, 0.0, 0.0, 2.0 * DRIVELESS))


def test_a_place_that_is_no_number_is_refused():
    with pytest.raises(GeometryError, match='wheel 1 must be finite'):
        require_driven(1, OmniWheel(0.0, nan, 0.0))
