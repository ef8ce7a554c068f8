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

from math import atan2, cos, isfinite, pi, sqrt, tau
from typing import TYPE_CHECKING

from agv_motion.errors import SignalError
from agv_motion.kinematics.steering_course import START_ERROR
from agv_motion.kinematics.steering_limits import SteeringLimits
from agv_motion.kinematics.steering_rest import choose_goals, turn_at_rest
from agv_motion.kinematics.steering_roll import roll
from agv_motion.kinematics.steering_state import POINT, STILL, Limiter, SteeringState
from agv_motion.planar import Twist, require_finite, wrap

if TYPE_CHECKING:
    from agv_motion.kinematics.steering_state import Direction
    from agv_motion.kinematics.turrets import Turrets

__all__ = ['Limiter', 'SteeringLimits', 'SteeringPlanner', 'SteeringState']

NEGLIGIBLE = 1e-9
"""[m/s] A slower twist is none."""

FREE_CHANGES = 3
"""Goals of the turrets at rest change freely so often; afterwards only to nearer ones, so that they
are reached whatever is asked for."""


class SteeringPlanner:
    """Plans for one platform; all that changes is in the :class:`SteeringState`."""

    def __init__(self, turrets: Turrets, limits: SteeringLimits) -> None:
        """Measure the platform.

        Args:
            turrets: Where the turrets are.
            limits: What they can do; may be replaced between steps.

        """
        self.turrets = turrets
        self.limits = limits
        n = len(turrets)
        self._x = sum(x for x, _ in turrets.positions) / n
        self._y = sum(y for _, y in turrets.positions) / n
        arms = [(x - self._x, y - self._y) for x, y in turrets.positions]
        self._length = sqrt(sum(x * x + y * y for x, y in arms) / n)
        self._arms = [(x / self._length, y / self._length) for x, y in arms]

    def step(self, state: SteeringState, twist: Twist, period: float) -> None:
        """Change ``state`` by one step towards ``twist``; nothing changes where this raises.

        Args:
            state: Of this platform.
            twist: Wanted velocity of the base frame.
            period: Time until the next step [s]; it may vary, best by no more than a factor of two.

        Raises:
            SignalError: The twist is not finite, the period not positive, or the state of another
                platform.

        """
        vx, vy, wz = twist
        if not isfinite(vx + vy + wz):
            require_finite('twist (vx, vy, wz)', twist)
        if not 0.0 < period < float('inf'):
            msg = f'period = {period} s: must be positive and finite'
            raise SignalError(msg)
        if len(state.angles) != len(self._arms):
            msg = f'a state of {len(state.angles)} turrets for {len(self._arms)}: make a new one'
            raise SignalError(msg)
        a, b, c = vx - wz * self._y, vy + wz * self._x, wz * self._length
        size = sqrt(a * a + b * b + c * c)
        wanted = (a / size, b / size, c / size) if size > NEGLIGIBLE else None
        if state.speed > 0.0:
            roll(self._arms, state, self.limits, wanted and (wanted, size), period)
        elif wanted is None:
            self._hold(state, period)
        elif state.aligned and self._near(state, wanted):
            roll(self._arms, state, self.limits, wanted and (wanted, size), period)
        else:
            self._align(state, wanted, period)
        state.period = period

    def stop(self, state: SteeringState) -> None:
        """Zero every wheel at once, angles held: for an emergency, not for a smooth stop."""
        n = len(state.speeds)
        state.speed, state.velocity = 0.0, STILL
        state.speeds[:], state.rates[:] = [0.0] * n, [0.0] * n
        state.aligned = state.aligned and state.free_turret < 0
        state.goals, state.free_turret, state.limiter = None, -1, Limiter.NONE

    def unwind(self, state: SteeringState, period: float) -> bool:
        """At rest, turn each turret for one step along its line to the angle nearest to zero.

        Returns:
            Whether all are there.

        Raises:
            SignalError: The platform rolls.

        """
        if state.speed > 0.0:
            msg = f'the platform rolls at {state.speed:.4f} m/s: stop it before unwinding'
            raise SignalError(msg)
        if state.goals is None or any(abs(goal) > pi / 2.0 + 1e-9 for goal in state.goals):
            state.goals = [angle - pi * round(angle / pi) for angle in state.angles]
        state.aligned = False
        there = turn_at_rest(state, self.limits, period)
        if there:
            state.goals = None
        state.limiter = Limiter.NONE if there else Limiter.UNWINDING
        state.period = period
        return there

    # At rest

    def _near(self, state: SteeringState, wanted: Direction) -> bool:
        """Return whether the rest of the way to ``wanted`` may be steered while rolling."""
        u = state.direction
        near = u[0] * wanted[0] + u[1] * wanted[1] + u[2] * wanted[2] > cos(START_ERROR)
        return near and not self._too_far(state, wanted)

    def _hold(self, state: SteeringState, period: float) -> None:
        state.goals, state.limiter = None, Limiter.NONE
        if any(state.rates):
            state.aligned = False
            turn_at_rest(state, self.limits, period)

    def _align(self, state: SteeringState, wanted: Direction, period: float) -> None:
        """Turn all turrets to where ``wanted`` needs them, the wheels at rest."""
        aim = state.goal_direction
        turned = aim[0] * wanted[0] + aim[1] * wanted[1] + aim[2] * wanted[2] < cos(START_ERROR)
        if state.goals is None or turned or state.limiter is Limiter.UNWINDING:
            self._set_goals(state, wanted)
        state.aligned = False
        state.limiter = Limiter.ALIGNING
        if turn_at_rest(state, self.limits, period):
            self._arrive(state)

    def _set_goals(self, state: SteeringState, wanted: Direction) -> None:
        goals, signs = choose_goals(state, self._bearings(wanted), self.limits)
        if state.goals is not None:
            left = max(abs(g - a) for g, a in zip(state.goals, state.angles, strict=True))
            there = max(abs(g - a) for g, a in zip(goals, state.angles, strict=True))
            if state.changes >= FREE_CHANGES and there > left:
                return
            state.changes += 1
        state.goals, state.goal_signs, state.goal_direction = goals, signs, wanted

    def _arrive(self, state: SteeringState) -> None:
        state.aligned, state.changes, state.goals = True, 0, None
        state.signs[:] = state.goal_signs
        state.direction, state.velocity = state.goal_direction, STILL
        a, b, c = state.direction
        state.lengths[:] = [sqrt((a - c * y) ** 2 + (b + c * x) ** 2) for x, y in self._arms]

    def _bearings(self, u: Direction) -> list[float | None]:
        """Return the direction in which each wheel moves [rad], None where it does not."""
        moves = [(u[0] - u[2] * y, u[1] + u[2] * x) for x, y in self._arms]
        return [atan2(y, x) if x * x + y * y > POINT * POINT else None for x, y in moves]

    def _too_far(self, state: SteeringState, wanted: Direction) -> bool:
        """Return whether a turret would leave its cables on the way to ``wanted``."""
        most = self.limits.turn_limit * tau
        for angle, sign, bearing in zip(
            state.angles, state.signs, self._bearings(wanted), strict=True
        ):
            if abs(angle) > most - pi and bearing is not None:
                turn = wrap(bearing + (pi if sign < 0.0 else 0.0) - angle)
                if abs(angle + turn) > most:
                    return True
        return False
