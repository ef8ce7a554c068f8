"""The three robots as links and joints: where an independent library has each part, too."""

from __future__ import annotations

import io
from math import cos, hypot, pi, sin

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.differential_platform import DifferentialBaseParameters
from agv_motion.kinematics.omni_platform import OmniBaseParameters
from agv_motion.kinematics.platform import PlatformParameters
from agv_motion.model.robots import differential_model, omni_model, tree_model
from agv_motion.model.transform import rotated
from agv_motion.model.urdf import write_urdf
from agv_motion.model.urdf_reading import read_urdf

FOUR = PlatformParameters(
    turret_x=(1.0, 1.0, -0.7, -0.7), turret_y=(0.5, -0.5, 0.6, -0.6), wheel_radius=0.123456789012345
)
MECANUM = OmniBaseParameters(
    wheel_angles=(0.7, -0.7, 2.4, -2.4), wheel_distances=(0.4, 0.4, 0.45, 0.4),
    wheel_directions=(0.0, 0.0, 0.1, -3.0), slide_angles=(0.785, -0.785, -0.785, 0.785),
    wheel_radii=(0.05, 0.06, 0.05, 0.07), joint_names=('front left', 'a<b', '"c"&', 'Rad_ü'),
)  # fmt: skip
UNEVEN = DifferentialBaseParameters(track=0.37, wheel_radii=(0.05, 0.04))
ROBOTS = {
    'tree': tree_model(PlatformParameters(), 'base_link'),
    'four turrets': tree_model(FOUR, 'base_footprint'),
    'omni': omni_model(OmniBaseParameters(), 'base_link'),
    'mecanum': omni_model(MECANUM, 'base_link'),
    'differential': differential_model(DifferentialBaseParameters(), 'base_link'),
    'uneven': differential_model(UNEVEN, 'base_link'),
}
robots = pytest.mark.parametrize('model', ROBOTS.values(), ids=ROBOTS)


def places(model, positions):
    """Return where each link is, seen from the base: a matrix of 4 by 4."""
    transforms = [*model.fixed(0, ''), *model.moved(0, '', positions)]
    found = {model.root: np.eye(4)}
    waiting = {t.child: t for t in transforms}
    while waiting:
        child, told = next((c, t) for c, t in waiting.items() if t.parent in found)
        del waiting[child]
        step = np.eye(4)
        step[:3, :3] = np.array([rotated(told.rotation, axis) for axis in np.eye(3).tolist()]).T
        step[:3, 3] = told.translation
        found[child] = found[told.parent] @ step
    return found


@robots
def test_an_independent_library_has_each_link_at_the_same_place(model):
    yourdfpy = pytest.importorskip('yourdfpy')
    text = write_urdf(model)
    other = yourdfpy.URDF.load(io.BytesIO(text.encode()), load_meshes=False)
    assert other.validate()
    assert other.base_link == model.root
    assert {link.name for link in other.robot.links} == {link.name for link in model.links}
    chance = np.random.default_rng(1)
    for _ in range(5):
        positions = {name: float(chance.uniform(-50.0, 50.0)) for name in model.moving}
        other.update_cfg(positions)
        for link, place in places(model, positions).items():
            seen = other.get_transform(link, model.root)
            np.testing.assert_allclose(seen, place, atol=1e-9, rtol=0.0)


@robots
def test_what_is_written_is_read_back_to_the_last_bit(model):
    again = read_urdf(write_urdf(model))
    assert again.joints == model.joints
    assert again.links == model.links
    assert again.root == model.root


def top_of(place, radius):
    """Return where the topmost point of a wheel at rest is now."""
    return (place @ np.array([0.0, 0.0, radius, 1.0]))[:3]


def test_turrets_stand_where_the_platform_has_them_and_their_wheels_touch_the_floor():
    model, radius = ROBOTS['four turrets'], FOUR.wheel_radius
    angles = {f'turret_{i}_steering': 0.3 * i - 0.4 for i in range(4)}
    still = places(model, angles | {f'turret_{i}_wheel': 0.0 for i in range(4)})
    rolled = places(model, angles | {f'turret_{i}_wheel': 1e-6 for i in range(4)})
    for i in range(4):
        name, angle = f'wheel_{i}', angles[f'turret_{i}_steering']
        assert still[name][:3, 3] == pytest.approx((FOUR.turret_x[i], FOUR.turret_y[i], radius))
        way = (top_of(rolled[name], radius) - top_of(still[name], radius)) / (1e-6 * radius)
        assert way == pytest.approx((cos(angle), sin(angle), 0.0), abs=1e-4)


def test_omni_wheels_roll_the_way_their_motors_drive():
    model = ROBOTS['mecanum']
    still = places(model, dict.fromkeys(MECANUM.joint_names, 0.0))
    rolled = places(model, dict.fromkeys(MECANUM.joint_names, 1e-6))
    for i, direction in enumerate(MECANUM.wheel_directions):
        name, radius = f'wheel_{i}', MECANUM.wheel_radii[i]
        way = (top_of(rolled[name], radius) - top_of(still[name], radius)) / (1e-6 * radius)
        assert way == pytest.approx((cos(direction), sin(direction), 0.0), abs=1e-4)
        x, y, z = still[name][:3, 3]
        assert (hypot(x, y), z) == pytest.approx((MECANUM.wheel_distances[i], radius))


def test_the_left_wheel_is_left_and_both_roll_forward():
    still = places(ROBOTS['uneven'], {'left_wheel': 0.0, 'right_wheel': 0.0})
    assert still['left_wheel'][:3, 3] == pytest.approx((0.0, 0.185, 0.05))
    assert still['right_wheel'][:3, 3] == pytest.approx((0.0, -0.185, 0.04))
    turned = places(ROBOTS['uneven'], {'left_wheel': pi / 2, 'right_wheel': 0.0})
    assert top_of(turned['left_wheel'], 0.05) == pytest.approx((0.05, 0.185, 0.05))


@pytest.mark.parametrize('base', ['turret_0', 'wheel_1', 'trunk', 'probe_1'])
def test_a_base_with_the_name_of_another_part_is_refused(base):
    with pytest.raises(ConfigurationError, match=f"two links '{base}'"):
        tree_model(PlatformParameters(), base)
