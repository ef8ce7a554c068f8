"""Where a platform on turrets is in its motion: all that the steering planner remembers."""

from __future__ import annotations

from enum import Enum
from math import isfinite
from typing import TYPE_CHECKING

from agv_motion.errors import SignalError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.kinematics.turrets import Turrets
    from agv_motion.planar import Twist


Direction = tuple[float, float, float]

STILL: Direction = (0.0, 0.0, 0.0)
"""Velocity of a direction that rests; told by identity."""

POINT = 1e-9
"""[-] Relative wheel velocity below which the centre of rotation lies at the turret."""


class Limiter(Enum):
    """What keeps the platform from making the wanted twist at once, in words for a person."""

    NONE = ''
    ALIGNING = 'turning the turrets before rolling'
    UNWINDING = 'unwinding the cables'
    STOPPING = 'stopping: from rest the turrets turn less far'
    STEERING_RATE = 'steering rate'
    STEERING_ACCELERATION = 'steering acceleration'
    WHEEL_ACCELERATION = 'wheel acceleration'
    WHEEL_SPEED = 'wheel speed'


class SteeringState:
    """One platform under way. The planner changes it in place; nothing else should.

    While the platform rolls, every turret stands square to the line from one centre of rotation,
    which is the one of ``twist``. At rest each turret stands anywhere.
    """

    __slots__ = (
        'aligned', 'angles', 'changes', 'direction', 'free_turret', 'goal_direction',
        'goal_signs', 'goals', 'lengths', 'limiter', 'period', 'rates', 'signs', 'speed', 'speeds',
        'velocity',
    )  # fmt: skip

    def __init__(self, angles: Sequence[float]) -> None:
        """Start at rest.

        Args:
            angles: (n,) steering angles as measured, turns counted [rad].

        Raises:
            SignalError: An angle is not finite.

        """
        if not all(map(isfinite, angles)):
            msg = f'turret angles must be finite, got {tuple(angles)}: look at the encoders'
            raise SignalError(msg)
        n = len(angles)
        self.angles = [float(angle) for angle in angles]
        """(n,) commanded steering angles, turns counted [rad]"""
        self.rates = [0.0] * n
        """(n,) of the last step [rad/s]"""
        self.speeds = [0.0] * n
        """(n,) commanded wheel speeds, negative where a wheel rolls backwards [m/s]"""
        self.limiter = Limiter.NONE
        """what was in force in the last step"""
        self.speed = 0.0
        """[m/s] length of the twist in the planner's measure; 0 at rest"""
        self.direction: Direction = (1.0, 0.0, 0.0)
        """unit twist (of the turrets' centroid; rotation by the turrets' mean distance)"""
        self.velocity: Direction = STILL
        """[1/s] of `direction`"""
        self.lengths = [1.0] * n
        """(n,) speed of each wheel while the platform moves at 1 m/s"""
        self.signs = [1.0] * n
        """(n,) -1 where a wheel is reversed"""
        self.aligned = False
        """whether the turrets stand as `direction` asks for"""
        self.free_turret = -1
        """the turret at the centre of rotation, while it turns there; else -1"""
        self.period = 0.0
        """[s] of the last step"""
        self.goals: list[float] | None = None
        """(n,) angles to which the turrets turn at rest [rad]"""
        self.goal_signs = [1.0] * n
        self.goal_direction: Direction = (1.0, 0.0, 0.0)
        self.changes = 0
        """how often the goals changed since they were last reached"""

    def twist(self, turrets: Turrets) -> Twist:
        """Return the twist of the base frame that the commanded wheels make."""
        return turrets.twist(self.angles, self.speeds).twist
