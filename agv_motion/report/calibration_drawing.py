"""A base as its node's parameters draw it: what a calibration starts from, and writes again."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.kinematics.turrets import Turrets
from agv_motion.odometry.calibration_models import DifferentialModel, OmniModel, TurretModel
from agv_motion.report.calibration_drive import Wheels, joints_of_turrets

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.bag.reader import BagReader
    from agv_motion.odometry.calibration_models import CalibrationModel

TURRET_NOISE = 0.005
"""[m] of a turret's wheel after one metre: its node has no parameter for it."""


class Drawing(NamedTuple):
    """A base as its node's parameters draw it."""

    model: CalibrationModel
    wheels: Wheels
    wheel_noise: float
    written: Callable[[dict[str, float]], dict[str, Any]]
    """parameters of the node, from the unknowns by name"""


def node_of(bag: BagReader, prefix: str = '') -> str:
    """Return whose robot is in the bag, by its topics and joints.

    Raises:
        ConfigurationError: It has none.

    """
    topics, path = bag.topics, bag.path
    if f'{prefix}/turrets/state' in topics:
        return 'wheel_kinematics'
    if f'{prefix}/wheels/state' in topics:
        free = f'{prefix}/wheels/free_speed' in topics
        return 'omni_kinematics' if free else 'differential_kinematics'
    msg = f'{path} has neither turrets/state nor wheels/state: it has {", ".join(sorted(topics))}'
    raise ConfigurationError(msg)


def drawing_of(node: str, given: Any, prefix: str = '') -> Drawing:
    """Return the drawing of a base.

    Args:
        node: Which kinematics the base has.
        given: Parameters of that node.
        prefix: Namespace of the robot in the bag, before the names of its topics.

    """
    if node == 'wheel_kinematics':
        turrets = Turrets.of(given)
        rolling, steering = joints_of_turrets(len(turrets))
        return Drawing(
            TurretModel(turrets, [given.wheel_radius] * len(turrets)),
            Wheels(f'{prefix}/turrets/state', rolling, steering),
            TURRET_NOISE,
            _turret_parameters,
        )
    noise, encoder_range = given.odometry.wheel_noise, given.odometry.encoder_range
    wheels = Wheels(f'{prefix}/wheels/state', list(given.joint_names), [], encoder_range)
    if node == 'differential_kinematics':
        track, track_drawn = given.track, given.track * given.track_multiplier
        return Drawing(
            DifferentialModel(track_drawn, given.wheel_radii),
            wheels,
            noise,
            lambda values: _differential_parameters(values, track),
        )
    return Drawing(
        OmniModel(OmniWheels.of(given), given.wheel_radii), wheels, noise, _omni_parameters
    )


def _all(values: dict[str, float], start: str) -> list[float]:
    return [round(value, 6) for name, value in values.items() if name.startswith(start)]


def _omni_parameters(values: dict[str, float]) -> dict[str, Any]:
    return {
        'wheel_radii': _all(values, 'radius_'),
        'wheel_distances': _all(values, 'distance_'),
    }


def _differential_parameters(values: dict[str, float], track: float) -> dict[str, Any]:
    return {
        'wheel_radii': _all(values, 'radius_'),
        'track_multiplier': round(values['track'] / track, 6),
    }


def _turret_parameters(values: dict[str, float]) -> dict[str, Any]:
    radii = _all(values, 'radius_')
    return {
        'wheel_radius': round(sum(radii) / len(radii), 6),  # the node has one for all wheels
        'steering_zero': _all(values, 'zero_'),
    }
