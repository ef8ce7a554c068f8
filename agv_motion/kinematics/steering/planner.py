r"""Steering planner: the next command of every turret, with one centre of rotation at all times.

A platform that rolls without slipping has all its wheel axes through one point. So the planner
does not move angles, it moves the *twist*, and derives every angle from that one twist. Only the
direction of the twist matters for the angles: a unit vector :math:`u`, in which the velocity of
wheel :math:`i` is linear, :math:`w_i = A_i u`. With :math:`\dot u = V`,

.. math:: \frac{w_i \cdot A_i V}{|w_i|^2} + j\,\frac{w_i \times A_i V}{|w_i|^2} = x_i + j y_i

:math:`y_i` is the steering rate of turret i, and :math:`x_i` the rate at which its wheel speed
grows. Going straight towards the wanted direction (a great circle), that a turret must turn by
between ``low`` and ``high`` in the next step is *linear* in the step, so the longest step that all
turrets can follow has a closed form.

Two bounds make sure that the next step exists as well. Braking along the great circle changes
:math:`y_i` by :math:`\dot y_i = -y_i (2 x_i + \lambda)` with :math:`\lambda = -\dot q / q` the
braking. With :math:`\lambda = 2 X`, :math:`X = \max(|V|, -\min x_i)`, neither X nor the largest
rate grows, and no :math:`|\dot y_i|` exceeds :math:`4 X \max |y_i|`. So X is held below
``acceleration / (8 rate)``: half of what the turrets can do, the other half is for turning aside.

At rest the turrets turn each for itself. From a standstill, and where a turret would have to turn
further than the reversal angle, the platform stops, turns them all, and goes on.
"""

from __future__ import annotations

from dataclasses import replace
from math import inf, isfinite, sqrt
from typing import TYPE_CHECKING

from agv_motion.errors import SignalError
from agv_motion.kinematics.steering.at_rest import align, hold, may_roll, unwind
from agv_motion.kinematics.steering.chassis import measure
from agv_motion.kinematics.steering.rolling import roll
from agv_motion.kinematics.steering.state import AtRest, Limiter, Rolling
from agv_motion.planar import STANDSTILL, Twist, require_twist

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.kinematics.steering.limits import SteeringLimits
    from agv_motion.kinematics.steering.state import Phase
    from agv_motion.kinematics.turrets import Turrets


class SteeringPlanner:
    """Plans for one platform; all that changes is in its phase, `AtRest` or `Rolling`."""

    def __init__(self, turrets: Turrets, limits: SteeringLimits) -> None:
        """Measure the platform.

        Args:
            turrets: Where the turrets are.
            limits: What they can do.

        """
        self.turrets = turrets
        self._chassis = measure(turrets, limits)
        self._coming: SteeringLimits | None = None

    @property
    def limits(self) -> SteeringLimits:
        """What the turrets can do; may be replaced between steps.

        A lower steering acceleration counts once no turret turns: those that do could not stop
        before their cables end.
        """
        return self._coming or self._chassis.limits

    @limits.setter
    def limits(self, limits: SteeringLimits) -> None:
        self._coming = limits

    def _take_limits(self, limits: SteeringLimits, rates: Sequence[float]) -> None:
        """Plan within ``limits``, as far as turrets that turn at ``rates`` [rad/s] can."""
        before = self._chassis.limits.steering_acceleration
        if limits.steering_acceleration < before and any(rates):
            limits = replace(limits, steering_acceleration=before)
        else:
            self._coming = None
        self._chassis = self._chassis._replace(limits=limits)

    def step(self, phase: Phase, twist: Twist, period: float) -> Phase:
        """Take one step towards ``twist``; nothing changes where this raises.

        Args:
            phase: Of this platform; used up: go on with the one that is returned.
            twist: Wanted velocity of the base frame.
            period: Time until the next step [s]; it may vary, best by no more than a factor of two.

        Returns:
            The phase after the step, whose ``setpoints`` are to be commanded.

        Raises:
            SignalError: The twist is not finite, or beyond any robot, the period not positive, or
                the phase of another platform.

        """
        vx, vy, wz = twist
        if self._coming is not None:
            self._take_limits(self._coming, phase.setpoints.rates)
        chassis, setpoints = self._chassis, phase.setpoints
        arms, limits, x, y, length = chassis
        if not 0.0 < period < inf:
            msg = f'period = {period} s: must be positive and finite'
            raise SignalError(msg)
        if len(setpoints.angles) != len(arms):
            msg = f'a state of {len(setpoints.angles)} turrets for {len(arms)}: make a new one'
            raise SignalError(msg)
        a, b, c = vx - wz * y, vy + wz * x, wz * length
        size = sqrt(a * a + b * b + c * c)
        if not isfinite(size):
            require_twist(twist)
        wanted = (a / size, b / size, c / size) if size > STANDSTILL else None
        if isinstance(phase, Rolling):
            phase = roll(chassis, phase, wanted, size, period)
        elif wanted is None:
            hold(phase, limits, period)
        elif phase.stance is not None and may_roll(chassis, phase, wanted):
            phase = roll(chassis, Rolling(setpoints, phase.stance), wanted, size, period)
        else:
            align(chassis, phase, wanted, period)
        setpoints.period = period
        return phase

    @staticmethod
    def stop(phase: Phase) -> AtRest:
        """Zero every wheel at once, angles held: for an emergency, not for a smooth stop."""
        setpoints, n = phase.setpoints, len(phase.setpoints.speeds)
        setpoints.speeds, setpoints.rates = [0.0] * n, [0.0] * n
        setpoints.limiter = Limiter.NONE
        if isinstance(phase, Rolling):
            return AtRest(setpoints, phase.stance)
        phase.goals = None
        return phase

    def unwind(self, phase: Phase, period: float) -> bool:
        """At rest, turn each turret for one step along its line to the angle nearest to zero.

        Returns:
            Whether all are there.

        Raises:
            SignalError: The platform rolls.

        """
        if isinstance(phase, Rolling):
            msg = f'the platform rolls at {phase.speed:.4f} m/s: stop it before unwinding'
            raise SignalError(msg)
        if self._coming is not None:
            self._take_limits(self._coming, phase.setpoints.rates)
        there = unwind(phase, self._chassis.limits, period)
        phase.setpoints.period = period
        return there
