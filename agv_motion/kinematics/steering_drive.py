"""A steering planner at work: the wanted twist, what the turrets tell, and time as it passes."""

from __future__ import annotations

from math import degrees, pi, tau
from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.kinematics.steering import SteeringPlanner
from agv_motion.kinematics.steering_state import SteeringState
from agv_motion.kinematics.turret_motion import alignment
from agv_motion.planar import REST, Twist, wrap

if TYPE_CHECKING:
    from agv_motion.kinematics.steering_limits import SteeringLimits
    from agv_motion.kinematics.turrets import Turrets

LOST_TURRET = 0.35
"""[rad] At rest, a turret so far from its command was turned by hand or did not follow: the
planner goes on from where it is."""

MOST_TURNS = 10.0
"""[turns] beyond its limit that a turret can be: it is unwound from there. More is no angle of a
turret, and nobody knows how far its cables are turned."""

SHARE_ROUNDING = 1.0 - 1e-9
"""A wheel that gains more than it may by less than this share does not."""

QUARTER = pi / 2.0
"""[rad] A turret turned further from straight, either way, can be unwound by half turns."""


class SteeringDrive:
    """Drives one platform: steps when they are due, unwinding, turrets that went astray."""

    def __init__(
        self, turrets: Turrets, limits: SteeringLimits, period: float, unwind_after: float
    ) -> None:
        """Know nothing of the turrets yet.

        Args:
            turrets: Where they are.
            limits: What they can do.
            period: Of the steps, about [s].
            unwind_after: Rest after which turned cables are unwound; 0: never by itself [s].

        """
        self.planner = SteeringPlanner(turrets, limits)
        self.plan: SteeringState | None = None
        """what is commanded; None while nothing is known of the turrets, nor wanted of them"""
        self.measured: list[float] | None = None
        """(n,) angles as they are [rad]; None where nobody tells"""
        self.unbelievable = ''
        """why the angles told last cannot be; empty if they can"""
        self.unwinding = False
        self._turrets, self._period, self._unwind_after = len(turrets), period, unwind_after
        self._wanted = REST
        self._rested = 0.0
        self._planned_at: float | None = None
        self._rolled = [0.0] * len(turrets)  # (n,) speeds commanded last, without sign [m/s]
        self._most_share = 1.0

    def see(self, angles: list[float]) -> None:
        """Take up the angles as they are, (n,) [rad], finite.

        Raises:
            SignalError: One is no angle of a turret; until better ones come, a platform of which
                nothing else is known stands.

        """
        most = (self.planner.limits.turn_limit + MOST_TURNS) * tau
        furthest = max(angles, key=abs)
        if not abs(furthest) <= most:
            self.unbelievable = (
                f'turret {angles.index(furthest)} stands at {furthest:.6g} rad, beyond {most:.4g} '
                'rad, which no cable allows: look at the encoder and its zero'
            )
            raise SignalError(self.unbelievable)
        self.unbelievable = ''
        if self.measured is None:
            self.plan = SteeringState(angles)
        self.measured = angles

    def overturned(self) -> str:
        """Return which turret stands beyond its turn limit, in words; empty if none does."""
        most = self.planner.limits.turn_limit * tau
        angles = self.plan.angles if self.plan is not None else []
        furthest = max(angles, key=abs, default=0.0)
        if abs(furthest) <= most:
            return ''
        return (
            f'turret {angles.index(furthest)} stands at {furthest:.4g} rad, beyond its turn_limit '
            f'of {most:.4g} rad: it turns back before the platform rolls'
        )

    def want(self, twist: Twist) -> None:
        """Aim at ``twist`` from now on; turrets that nobody tells of are taken for straight."""
        self._wanted = twist
        if any(twist):
            self.unwinding = False
            if self.plan is None and not self.unbelievable:
                self.plan = SteeringState(self.measured or [0.0] * self._turrets)

    def stop(self) -> None:
        """Stop all wheels at once, and hold the angles."""
        self._wanted, self.unwinding = REST, False
        self._rolled = [0.0] * self._turrets
        if self.plan is not None:
            self.planner.stop(self.plan)

    def start_anew(self) -> None:
        """Go on from where the turrets are, whatever was commanded before."""
        if self.plan is not None:
            self.plan = SteeringState(self._seen(self.plan))

    def unwind(self) -> str:
        """Begin to unwind the cables; return in words what comes of it.

        Raises:
            ConfigurationError: The platform is driving.

        """
        plan = self.plan
        if plan is None or not _is_wound(plan):
            return 'nothing to unwind: every turret is within a quarter turn of straight'
        if plan.speed > 0.0 or any(self._wanted):
            msg = 'the platform is driving: send a zero cmd_vel before unwinding'
            raise ConfigurationError(msg)
        self.unwinding = True
        furthest = max(plan.angles, key=abs)
        return f'unwinding, the furthest turret by {degrees(pi * round(furthest / pi)):.0f} deg'

    def step(self, now: float, soonest: float) -> bool:
        """Plan one step if ``soonest`` [s] have passed since the last; return whether they have."""
        plan, period = self.plan, self._period
        elapsed = period if self._planned_at is None else now - self._planned_at
        if plan is None or 0.0 <= elapsed <= soonest:
            return False
        self._planned_at = now
        if not 0.0 < elapsed < 2.0 * period:  # the clock jumped, or there was nothing to do
            elapsed = period
        if plan.speed == 0.0 and self._is_astray(plan):
            self.plan = plan = SteeringState(self._seen(plan))
        self._rested = 0.0 if any(self._wanted) else self._rested + elapsed
        if self.unwinding or (0.0 < self._unwind_after < self._rested and _is_wound(plan)):
            self.unwinding = plan.speed > 0.0 or not self.planner.unwind(plan, elapsed)
        if plan.speed > 0.0 or not self.unwinding:
            self.planner.step(plan, self._wanted, elapsed)
        self._hold_acceleration(plan, self.planner.limits.wheel_acceleration * elapsed)
        return True

    def share(self) -> float:
        """Return the share of the planned speeds at which to roll, as the turrets have turned."""
        plan, measured = self.plan, self.measured
        if plan is None or measured is None or not plan.speed:
            return 1.0
        return min(alignment(plan.angles, measured), self._most_share)

    def _hold_acceleration(self, plan: SteeringState, change: float) -> None:
        """Let the share rise so far that no wheel gains more than ``change`` [m/s] in a step.

        It may fall at once: turrets that went astray must not be pulled along.
        """
        self._most_share = 1.0
        for speed, before in zip(plan.speeds, self._rolled, strict=True):
            if abs(speed) * SHARE_ROUNDING > before + change:
                self._most_share = min(self._most_share, (before + change) / abs(speed))
        share = self.share()
        self._rolled = [share * abs(speed) for speed in plan.speeds]

    def _seen(self, plan: SteeringState) -> list[float]:
        """Return the measured angles, the turns of encoders that wrap counted on [rad]."""
        measured = self.measured or plan.angles
        return [told + wrap(seen - told) for told, seen in zip(plan.angles, measured, strict=True)]

    def _is_astray(self, plan: SteeringState) -> bool:
        """Return whether a turret stands elsewhere than the plan has it, and nothing moves."""
        if self.measured is None or any(plan.rates):
            return False
        for told, seen in zip(plan.angles, self.measured, strict=True):
            if abs(wrap(seen - told)) > LOST_TURRET:
                return True
        return False


def _is_wound(plan: SteeringState) -> bool:
    return max(plan.angles) > QUARTER or min(plan.angles) < -QUARTER
