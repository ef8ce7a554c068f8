"""The outline of the platform: told once, and read by all that need it."""

from __future__ import annotations

from math import inf, nan

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.platform import PlatformOutline, PlatformParameters
from agv_motion.kinematics.turrets import Turrets

pytest.importorskip('rclpy')

from agv_motion.nodes.motion_parameters import MotionGeneratorParameters


def test_the_octagon_reaches_as_far_as_its_turrets():
    assert PlatformOutline().rim == pytest.approx(1.18)
    assert PlatformOutline(turret_x=(2.0, -1.0), turret_y=(0.0, 1.0)).rim == 2.0
    assert PlatformOutline(platform_radius=1.5).rim == 1.5


@pytest.mark.parametrize('kind', [PlatformParameters, MotionGeneratorParameters])
@pytest.mark.parametrize(
    'given',
    [
        {'platform_radius': nan}, {'platform_radius': inf}, {'platform_radius': -1.0},
        {'platform_radius': 1e-9}, {'turret_x': (0.0,), 'turret_y': (0.0,)},
        {'turret_x': (1.0, 1.0)},
    ],
)  # fmt: skip
def test_an_outline_that_is_none_is_refused(kind, given):
    with pytest.raises(ConfigurationError, match=r'platform_radius|turret'):
        kind(**given)


@pytest.mark.parametrize('radius', [0.3, 1.18, 2.0])
def test_agent_and_reservations_have_the_rim_of_the_platform(radius):
    given = MotionGeneratorParameters(platform_radius=radius)
    assert given.agent().platform_radius == radius
    assert given.sharing().body == radius
    assert given.sharing().tolerance == given.traffic.tolerance


def test_a_turret_outside_the_rim_is_refused():
    with pytest.raises(ConfigurationError, match=r'turret stands 1.18 m .* outside .* = 0.5 m'):
        PlatformParameters(platform_radius=0.5).turret_positions()


def test_a_turret_may_stand_on_the_rim_to_a_thousandth_of_a_millimetre():
    on = {'turret_x': (1.0, -1.0), 'turret_y': (0.0, 0.0)}
    assert len(PlatformParameters(platform_radius=1.0 - 9e-7, **on).turret_positions()) == 2
    with pytest.raises(ConfigurationError, match='outside platform_radius'):
        PlatformParameters(platform_radius=1.0 - 1.5e-6, **on).turret_positions()
    assert PlatformOutline(turret_x=(0.01,), turret_y=(0.0,)).rim == 0.01
    with pytest.raises(ConfigurationError, match=r'give platform_radius, >= 0\.01 m'):
        PlatformOutline(turret_x=(0.0099,), turret_y=(0.0,))


def test_the_turrets_stand_where_the_outline_says():
    given = PlatformParameters(turret_x=(2.0, -1.0), turret_y=(0.0, 1.0))
    assert Turrets.of(given).positions == ((2.0, 0.0), (-1.0, 1.0))
