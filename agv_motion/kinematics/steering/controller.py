"""A steering planner at work: the wanted twist, the measured angles, and time as it passes."""

from __future__ import annotations

from math import degrees, pi, tau
from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.kinematics.steering.alignment import rolling_share
from agv_motion.kinematics.steering.planner import SteeringPlanner
from agv_motion.kinematics.steering.state import AtRest, Rolling
from agv_motion.planar import REST, Twist, wrap

if TYPE_CHECKING:
    from agv_motion.kinematics.steering.limits import SteeringLimits
    from agv_motion.kinematics.steering.state import Phase, Setpoints
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


class SteeringController:
    """Controls one platform: steps when they are due, unwinding, turrets that went astray."""

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
        self.measured: list[float] | None = None
        """(n,) angles as they are [rad]; None while nobody measures them"""
        self.unbelievable = ''
        """why the angles measured last cannot be; empty if they can"""
        self.unwinding = False
        self._phase: Phase | None = None
        self._turrets, self._period, self._unwind_after = len(turrets), period, unwind_after
        self._target = REST
        self._rested = 0.0
        self._planned_at: float | None = None
        self._rolled = [0.0] * len(turrets)  # (n,) speeds commanded last, without sign [m/s]
        self._most_share = 1.0

    @property
    def setpoints(self) -> Setpoints | None:
        """What is commanded; None while nothing is known of the turrets, nor wanted of them."""
        return None if self._phase is None else self._phase.setpoints

    def set_measured(self, angles: list[float]) -> None:
        """Take up the angles as they are, (n,) [rad].

        Raises:
            SignalError: One is no angle of a turret; until better ones come, a platform of which
                nothing else is known stands.

        """
        most = (self.planner.limits.turn_limit + MOST_TURNS) * tau
        for i, angle in enumerate(angles):
            if not abs(angle) <= most:  # also true when NaN
                self.unbelievable = (
                    f'turret {i} stands at {angle:.6g} rad, beyond {most:.4g} rad, which no cable '
                    'allows: look at the encoder and its zero'
                )
                raise SignalError(self.unbelievable)
        self.unbelievable = ''
        if self.measured is None:
            self._phase = AtRest.at(angles)
        self.measured = angles

    def overturned(self) -> str:
        """Return which turret stands beyond its turn limit, in words; empty if none does."""
        most = self.planner.limits.turn_limit * tau
        angles = [] if self._phase is None else self._phase.setpoints.angles
        furthest = max(angles, key=abs, default=0.0)
        if abs(furthest) <= most:
            return ''
        return (
            f'turret {angles.index(furthest)} stands at {furthest:.4g} rad, beyond its turn_limit '
            f'of {most:.4g} rad: it turns back before the platform rolls'
        )

    def set_target(self, twist: Twist) -> None:
        """Aim at ``twist`` from now on; turrets that nobody measures are taken for straight."""
        self._target = twist
        if any(twist):
            self.unwinding = False
            if self._phase is None and not self.unbelievable:
                self._phase = AtRest.at(self.measured or [0.0] * self._turrets)

    def stop(self) -> None:
        """Stop all wheels at once, and hold the angles."""
        self._target, self.unwinding = REST, False
        self._rolled = [0.0] * self._turrets
        if self._phase is not None:
            self._phase = self.planner.stop(self._phase)

    def start_anew(self) -> None:
        """Go on from where the turrets are, whatever was commanded before."""
        if self._phase is not None:
            self._phase = AtRest.at(self._measured_turns(self._phase.setpoints))

    def unwind(self) -> str:
        """Begin to unwind the cables; return in words what comes of it.

        Raises:
            ConfigurationError: The platform is driving.

        """
        phase = self._phase
        if phase is None or not _is_wound(phase.setpoints):
            return 'nothing to unwind: every turret is within a quarter turn of straight'
        if isinstance(phase, Rolling) or any(self._target):
            msg = 'the platform is driving: send a zero cmd_vel before unwinding'
            raise ConfigurationError(msg)
        self.unwinding = True
        furthest = max(phase.setpoints.angles, key=abs)
        return f'unwinding, the furthest turret by {degrees(pi * round(furthest / pi)):.0f} deg'

    def step(self, now: float, soonest: float) -> bool:
        """Plan one step if ``soonest`` [s] have passed since the last; return whether they have."""
        phase, period = self._phase, self._period
        elapsed = period if self._planned_at is None else now - self._planned_at
        if phase is None or 0.0 <= elapsed <= soonest:
            return False
        self._planned_at = now
        if not 0.0 < elapsed < 2.0 * period:  # the clock jumped, or there was nothing to do
            elapsed = period
        if isinstance(phase, AtRest) and self._is_astray(phase.setpoints):
            self._phase = phase = AtRest.at(self._measured_turns(phase.setpoints))
        self._rested = 0.0 if any(self._target) else self._rested + elapsed
        due = 0.0 < self._unwind_after < self._rested and _is_wound(phase.setpoints)
        if self.unwinding or due:
            rolls = isinstance(phase, Rolling)
            self.unwinding = rolls or not self.planner.unwind(phase, elapsed)
        if isinstance(phase, Rolling) or not self.unwinding:
            self._phase = phase = self.planner.step(phase, self._target, elapsed)
        self._hold_acceleration(phase.setpoints, self.planner.limits.wheel_acceleration * elapsed)
        return True

    def share(self) -> float:
        """Return the share of the planned speeds at which to roll, as the turrets have turned."""
        measured = self.measured
        if measured is None or not isinstance(self._phase, Rolling):
            return 1.0
        return min(rolling_share(self._phase.setpoints.angles, measured), self._most_share)

    def _hold_acceleration(self, setpoints: Setpoints, change: float) -> None:
        """Let the share rise so far that no wheel gains more than ``change`` [m/s] in a step.

        It may fall at once: turrets that went astray must not be pulled along.
        """
        self._most_share = 1.0
        for speed, before in zip(setpoints.speeds, self._rolled, strict=True):
            if abs(speed) * SHARE_ROUNDING > before + change:
                self._most_share = min(self._most_share, (before + change) / abs(speed))
        share = self.share()
        self._rolled = [share * abs(speed) for speed in setpoints.speeds]

    def _measured_turns(self, setpoints: Setpoints) -> list[float]:
        """Return the measured angles, the turns of encoders that wrap counted on [rad]."""
        measured = self.measured or setpoints.angles
        pairs = zip(setpoints.angles, measured, strict=True)
        return [planned + wrap(angle - planned) for planned, angle in pairs]

    def _is_astray(self, setpoints: Setpoints) -> bool:
        """Return whether a turret stands elsewhere than it was told to, and nothing moves."""
        if self.measured is None or any(setpoints.rates):
            return False
        for planned, angle in zip(setpoints.angles, self.measured, strict=True):
            if abs(wrap(angle - planned)) > LOST_TURRET:
                return True
        return False


def _is_wound(setpoints: Setpoints) -> bool:
    return max(setpoints.angles) > QUARTER or min(setpoints.angles) < -QUARTER
