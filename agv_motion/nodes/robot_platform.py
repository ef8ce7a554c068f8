"""The shape of a robot, as the node that drives its wheels has it among its parameters."""

from __future__ import annotations

from math import cos, hypot, isfinite, sin
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.nodes.robot_parameters import RobotParameters

    Values = dict[str, Any]

ASKED = {
    'wheel_kinematics': ['turret_x', 'turret_y', 'platform_radius', 'wheel_radius',
                         'max_wheel_speed'],
    'omni_kinematics': ['wheel_angles', 'wheel_distances', 'wheel_directions', 'wheel_radii',
                        'max_wheel_speed'],
    'differential_kinematics': ['track', 'wheel_radii', 'max_wheel_speed'],
    'simulator': ['latitude', 'longitude'],
}  # fmt: skip
"""Nodes that tell of the shape or the place, and their parameters for it"""
MOST = 32
"""turrets or wheels"""


def read_platform(
    parameters: RobotParameters, robot: str, answer: Callable[[Values], None]
) -> None:
    """Ask a robot's nodes for its shape; ``answer`` gets it, empty if nobody tells.

    The shape has ``kind``, ``radius`` [m], ``turrets`` or ``wheels`` in the robot's frame,
    ``wheel_radius`` and ``wheel_radii`` [m], ``max_speed`` [m/s] and ``max_turn`` [rad/s].
    """
    names = [name for name in ASKED if name in parameters.nodes(robot)]
    shape: Values = {}
    left = len(names)

    def take(node: str, told: Values | None) -> None:
        nonlocal left
        left -= 1
        if told is not None:
            shape.update(shape_of(node, told))
        if left == 0:
            answer(shape if 'kind' in shape else {})

    for name in names:
        parameters.get(robot, name, ASKED[name], lambda told, name=name: take(name, told))  # type: ignore[misc] # default of a lambda


def shape_of(node: str, told: Values) -> Values:
    """Return what the parameters of a node tell of a robot's shape; empty where they make none."""
    try:
        shape: Values = _SHAPES[node](told)
        if 'radius' in shape:
            radius, speed = shape['radius'], float(told['max_wheel_speed'])
            shape |= {'max_speed': speed, 'max_turn': speed / radius if radius > 0.0 else 0.0}
    except (TypeError, ValueError, KeyError, IndexError, ZeroDivisionError, OverflowError):
        return {}
    numbers = (value for value in shape.values() if isinstance(value, float))
    return shape if all(map(isfinite, numbers)) else {}


def _tree(told: Values) -> Values:
    places = [(float(x), float(y)) for x, y in zip(
        told['turret_x'][:MOST], told['turret_y'][:MOST], strict=True)]  # fmt: skip
    radius = float(told['platform_radius']) or max(hypot(x, y) for x, y in places)
    return {
        'kind': 'tree', 'radius': radius, 'turrets': [list(place) for place in places],
        'wheel_radius': float(told['wheel_radius']),
    }  # fmt: skip


def _omni(told: Values) -> Values:
    rows = zip(told['wheel_angles'][:MOST], told['wheel_distances'][:MOST],
               told['wheel_directions'][:MOST], strict=True)  # fmt: skip
    wheels = [
        {'x': distance * cos(angle), 'y': distance * sin(angle), 'angle': float(direction)}
        for angle, distance, direction in rows
    ]
    radii = [float(radius) for radius in told['wheel_radii'][:MOST]]
    radius = max(map(float, told['wheel_distances'][:MOST])) + max(radii)
    return {'kind': 'omni', 'radius': radius, 'wheels': wheels, 'wheel_radii': radii,
            'wheel_radius': radii[0]}  # fmt: skip


def _differential(told: Values) -> Values:
    half = 0.5 * float(told['track'])
    radii = [float(radius) for radius in told['wheel_radii'][:2]]
    return {
        'kind': 'differential', 'radius': half + max(radii),
        'wheels': [{'x': 0.0, 'y': half, 'angle': 0.0}, {'x': 0.0, 'y': -half, 'angle': 0.0}],
        'wheel_radii': radii, 'wheel_radius': radii[0],
    }  # fmt: skip


def _place(told: Values) -> Values:
    return {'latitude': float(told['latitude']), 'longitude': float(told['longitude'])}


_SHAPES: dict[str, Callable[[Values], Values]] = {
    'wheel_kinematics': _tree, 'omni_kinematics': _omni,
    'differential_kinematics': _differential, 'simulator': _place,
}  # fmt: skip
