"""What the steering planner remembers of a platform: the set points, and one of two phases."""

from __future__ import annotations

from enum import Enum
from math import isfinite
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import SignalError
from agv_motion.kinematics.steering.direction import STILL

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.kinematics.steering.direction import Direction
    from agv_motion.kinematics.turrets import Turrets
    from agv_motion.planar import Twist


FORWARDS, BACKWARDS = 1.0, -1.0
"""How a wheel rolls along the angle of its turret: the sign of its speed."""


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


class Setpoints:
    """What every turret and wheel is commanded; the planner's output, changed in place."""

    __slots__ = ('angles', 'limiter', 'period', 'rates', 'signs', 'speeds')

    def __init__(self, angles: Sequence[float]) -> None:
        """Stand still.

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
        """(n,) steering angles, turns counted [rad]"""
        self.rates = [0.0] * n
        """(n,) mean steering rates over the last step [rad/s]"""
        self.speeds = [0.0] * n
        """(n,) wheel speeds, negative where a wheel rolls backwards [m/s]"""
        self.signs = [FORWARDS] * n
        """(n,) `BACKWARDS` where a wheel is reversed, also while it stands"""
        self.period = 0.0
        """[s] of the last step; 0 before the first"""
        self.limiter = Limiter.NONE
        """what was in force in the last step: a report, which the planner never reads"""

    def twist(self, turrets: Turrets) -> Twist:
        """Return the twist of the base frame that the commanded wheels make."""
        return turrets.twist(self.angles, self.speeds).twist


class Stance(NamedTuple):
    """The turrets stand as one direction of the twist asks for, so that all wheels may roll."""

    direction: Direction
    lengths: list[float]
    """(n,) speed of each wheel while the platform moves at 1 m/s [m/s]"""


class Goals(NamedTuple):
    """Where the turrets of a platform at rest turn to."""

    angles: list[float]
    """(n,) [rad]"""
    signs: list[float]
    """(n,) `BACKWARDS` where the wheel shall roll so"""
    direction: Direction | None
    """in which the platform shall roll from there; None: the cables are unwound"""


class AtRest:
    """All wheels stand, and each turret turns for itself."""

    __slots__ = ('changes', 'goals', 'setpoints', 'stance')

    def __init__(self, setpoints: Setpoints, stance: Stance | None = None) -> None:
        """Stand.

        Args:
            setpoints: As they are; the phases of a platform hand them on.
            stance: As which the turrets stand, if they do.

        """
        self.setpoints = setpoints
        self.stance = stance
        self.goals: Goals | None = None
        """where the turrets are turning to"""
        self.changes = 0
        """how often the goals changed since they were last reached"""

    @classmethod
    def at(cls, angles: Sequence[float]) -> AtRest:
        """Return a platform whose turrets stand at ``angles``, (n,) as measured [rad].

        Raises:
            SignalError: An angle is not finite.

        """
        return cls(Setpoints(angles))


class Rolling:
    """The platform moves, and every turret stands square to the line from one centre of rotation.

    It is the centre of the twist in ``direction``.
    """

    __slots__ = (
        'direction', 'free_turret', 'lengths', 'setpoints', 'speed', 'stopping', 'velocity',
    )  # fmt: skip

    def __init__(self, setpoints: Setpoints, stance: Stance) -> None:
        """Start from rest, the turrets in ``stance``."""
        self.setpoints = setpoints
        self.direction, self.lengths = stance
        self.velocity = STILL
        """[1/s] of ``direction``"""
        self.speed = 0.0
        """[m/s] length of the twist in the planner's measure"""
        self.free_turret: int | None = None
        """number of the turret at the centre of rotation, while it turns there"""
        self.stopping = False
        """whether it comes to rest because a turret would have to turn too far"""

    @property
    def stance(self) -> Stance | None:
        """As which the turrets stand; None while one of them turns for itself."""
        return Stance(self.direction, self.lengths) if self.free_turret is None else None


Phase = AtRest | Rolling
