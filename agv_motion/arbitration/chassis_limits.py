r"""How fast the whole robot may move, and how fast that may change, whoever asks for it.

Every limit holds of the whole twist :math:`\xi = (v_x, v_y, \omega)` by one factor, so that its
direction and its centre of rotation stay; a change goes along the straight line between two twists,

.. math:: \xi' = \xi + \lambda\,(\xi_t - \xi), \qquad
    \lambda = \min\left(1, \frac{a\,\Delta t}{|\Delta v|}, \frac{a_y\,\Delta t}{|\Delta v_y|},
    \frac{\alpha\,\Delta t}{|\Delta\omega|}\right)                                      \tag{1}

Between two twists within the limits of speed all are, for these limits are convex.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, inf, isfinite
from typing import Annotated

from agv_motion.errors import SignalError
from agv_motion.parameters import Spec, check
from agv_motion.planar import REST, THERE, Twist, require_finite


@dataclass(frozen=True)
class ChassisLimitParameters:
    """Limits of the whole robot; 0 is no limit."""

    linear_speed: Annotated[
        float, Spec('fastest it may go, in any direction; 0: no limit', 'm/s', (0.0, 1000.0))
    ] = 0.0
    lateral_speed: Annotated[
        float, Spec('fastest it may go sideways; 0: no limit', 'm/s', (0.0, 1000.0))
    ] = 0.0
    turn_rate: Annotated[
        float, Spec('fastest it may turn; 0: no limit', 'rad/s', (0.0, 1000.0))
    ] = 0.0
    linear_acceleration: Annotated[
        float, Spec('change of its velocity; 0: no limit', 'm/s2', (0.0, 1000.0))
    ] = 0.0
    lateral_acceleration: Annotated[
        float, Spec('change of its velocity sideways; 0: no limit', 'm/s2', (0.0, 1000.0))
    ] = 0.0
    turn_acceleration: Annotated[
        float, Spec('change of its turn rate; 0: no limit', 'rad/s2', (0.0, 1000.0))
    ] = 0.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class ChassisLimits:
    """What may be commanded, one command after the other; it remembers the last.

    A zero passes at once: how hard the wheels may brake they know best. What moved begins again
    from rest.
    """

    def __init__(self, given: ChassisLimitParameters) -> None:
        """Start at rest."""
        self._speeds = _or_none(given.linear_speed, given.lateral_speed, given.turn_rate)
        self._accelerations = _or_none(
            given.linear_acceleration, given.lateral_acceleration, given.turn_acceleration
        )
        self.twist = REST
        """what was commanded last"""
        self.target = REST
        """what it becomes, if nobody asks for anything else"""

    @property
    def settled(self) -> bool:
        """Whether nothing changes until something else is asked for."""
        return self.twist == self.target

    def stop(self) -> Twist:
        """Stand at once."""
        self.twist = self.target = REST
        return REST

    def apply(self, wanted: Twist, dt: float) -> Twist:
        """Return what may be commanded ``dt`` [s] after the last command.

        Raises:
            SignalError: A number is not finite, or ``dt`` is negative.

        """
        require_finite('twist (vx, vy, wz)', wanted)
        if not (isfinite(dt) and dt >= 0.0):
            msg = f'time step {dt} s: must be zero or more and finite'
            raise SignalError(msg)
        if wanted == REST:
            return self.stop()
        excess = _most(wanted, self._speeds)
        self.target = wanted if excess <= 1.0 else _scaled(wanted, 1.0 / excess)
        gap = Twist(*(goal - at for goal, at in zip(self.target, self.twist, strict=True)))
        steps = _most(gap, self._accelerations)
        if steps * THERE <= dt:
            self.twist = self.target
        else:
            change = _scaled(gap, dt / steps)
            self.twist = Twist(*(at + d for at, d in zip(self.twist, change, strict=True)))
        return self.twist


def _or_none(*limits: float) -> tuple[float, float, float]:
    linear, lateral, turn = (limit or inf for limit in limits)
    return linear, lateral, turn


def _most(twist: Twist, limits: tuple[float, float, float]) -> float:
    """Return how many times a limit goes into its part of a twist, of the limit nearest to it."""
    linear, lateral, turn = limits
    speed = hypot(twist.vx, twist.vy)
    return max(speed / linear, abs(twist.vy) / lateral, abs(twist.wz) / turn)


def _scaled(twist: Twist, factor: float) -> Twist:
    return Twist(factor * twist.vx, factor * twist.vy, factor * twist.wz)
