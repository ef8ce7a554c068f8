"""A steering planner at work: the wanted twist, the measured angles, and time as it passes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.kinematics.steering.alignment import RollingShare
from agv_motion.kinematics.steering.planner import SteeringPlanner
from agv_motion.kinematics.steering.readings import TurretReadings
from agv_motion.kinematics.steering.state import AtRest, Rolling
from agv_motion.kinematics.steering.step_clock import StepClock
from agv_motion.kinematics.steering.unwinding import Unwinding, describe, is_wound
from agv_motion.planar import REST, Twist, require_twist

if TYPE_CHECKING:
    from agv_motion.kinematics.steering.limits import SteeringLimits
    from agv_motion.kinematics.steering.state import Phase, Setpoints
    from agv_motion.kinematics.turrets import Turrets


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
        self._phase: Phase | None = None
        self._target = REST
        self._readings = TurretReadings()
        self._share = RollingShare(len(turrets))
        self._unwinding = Unwinding(unwind_after)
        self._clock = StepClock(period)

    @property
    def setpoints(self) -> Setpoints | None:
        """What is commanded; None while nothing is known of the turrets, nor wanted of them."""
        return None if self._phase is None else self._phase.setpoints

    @property
    def measured(self) -> list[float] | None:
        """(n,) angles as they are [rad]; None while nobody measures them."""
        return self._readings.angles

    @property
    def unbelievable(self) -> str:
        """Why the angles measured last cannot be; empty if they can."""
        return self._readings.unbelievable

    @property
    def unwinding(self) -> bool:
        """Whether the cables are being unwound."""
        return self._unwinding.asked

    def set_measured(self, angles: list[float]) -> None:
        """Take up the angles as they are, (n,) [rad].

        Raises:
            SignalError: Their number is wrong, or one is no angle of a turret; until better ones
                come, a platform of which nothing else is known stands.

        """
        if len(angles) != len(self.planner.turrets):
            msg = f'{len(angles)} angles for {len(self.planner.turrets)} turrets: give one each'
            raise SignalError(msg)
        first = self._readings.angles is None
        self._readings.update(angles, self.planner.limits.turn_limit)
        if first:
            self._phase = AtRest.at(angles)

    def overturned(self) -> str:
        """Return which turret stands beyond its turn limit, in words; empty if none does."""
        if self._phase is None:
            return ''
        most, angles = self.planner.limits.cables_end, self._phase.setpoints.angles
        furthest = max(angles, key=abs)
        if abs(furthest) <= most:
            return ''
        return (
            f'turret {angles.index(furthest)} stands at {furthest:.4g} rad, beyond its turn_limit '
            f'of {most:.4g} rad: it turns back before the platform rolls'
        )

    def set_target(self, twist: Twist) -> None:
        """Aim at ``twist`` from now on; turrets that nobody measures are taken for straight.

        Raises:
            SignalError: A number of it is not finite, or beyond any robot; the last one holds.

        """
        require_twist(twist)
        self._target = twist
        if any(twist):
            self._unwinding.asked = False
            if self._phase is None and not self.unbelievable:
                self._phase = AtRest.at(self.measured or [0.0] * len(self.planner.turrets))

    def stop(self) -> None:
        """Stop all wheels at once, and hold the angles."""
        self._target, self._unwinding.asked = REST, False
        self._share.stop()
        if self._phase is not None:
            self._phase = self.planner.stop(self._phase)

    def start_anew(self) -> None:
        """Go on from where the turrets are, whatever was commanded before."""
        if self._phase is not None:
            self._phase = AtRest.at(self._readings.turns(self._phase.setpoints))

    def unwind(self) -> str:
        """Begin to unwind the cables; return in words what comes of it.

        Raises:
            ConfigurationError: The platform is driving.

        """
        phase = self._phase
        if phase is None or not is_wound(phase.setpoints):
            return 'nothing to unwind: every turret is within a quarter turn of straight'
        if isinstance(phase, Rolling) or any(self._target):
            msg = 'the platform is driving: send a zero cmd_vel before unwinding'
            raise ConfigurationError(msg)
        self._unwinding.asked = True
        return describe(phase.setpoints)

    def step(self, now: float, soonest: float) -> bool:
        """Plan one step if ``soonest`` [s] have passed since the last; return whether they have."""
        phase, readings = self._phase, self._readings
        elapsed = None if phase is None else self._clock.elapsed(now, soonest)
        if phase is None or elapsed is None:
            return False
        if isinstance(phase, AtRest) and readings.are_astray(phase.setpoints):
            self._phase = phase = AtRest.at(readings.turns(phase.setpoints))
        rolls, wanted = isinstance(phase, Rolling), any(self._target)
        if self._unwinding.is_due(phase.setpoints, elapsed, wanted=wanted):
            self._unwinding.asked = rolls or not self.planner.unwind(phase, elapsed)
        if rolls or not self.unwinding:
            self._phase = phase = self.planner.step(phase, self._target, elapsed)
        gain = self.planner.limits.wheel_acceleration * elapsed
        self._share.update(phase, readings.angles, gain)
        return True

    def share(self) -> float:
        """Return the share of the planned speeds at which to roll, as the turrets have turned."""
        return self._share.of(self._phase, self._readings.angles)
