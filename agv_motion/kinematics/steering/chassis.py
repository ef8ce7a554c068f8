"""One platform in the measure of the steering planner."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from agv_motion.kinematics.steering.direction import Arms
    from agv_motion.kinematics.steering.limits import SteeringLimits
    from agv_motion.kinematics.turrets import Turrets


class Chassis(NamedTuple):
    """Where the turrets are, seen from their centroid, and what they can do."""

    arms: Arms
    limits: SteeringLimits
    x: float
    """[m] of the centroid in the base frame"""
    y: float
    """[m]"""
    length: float
    """[m] root mean square distance of the turrets from their centroid"""


def measure(turrets: Turrets, limits: SteeringLimits) -> Chassis:
    """Return the chassis that stands on ``turrets``."""
    n = len(turrets)
    x, y = (sum(column) / n for column in zip(*turrets.positions, strict=True))
    arms = [(turret_x - x, turret_y - y) for turret_x, turret_y in turrets.positions]
    length = sqrt(sum(dx * dx + dy * dy for dx, dy in arms) / n)
    return Chassis([(dx / length, dy / length) for dx, dy in arms], limits, x, y, length)
