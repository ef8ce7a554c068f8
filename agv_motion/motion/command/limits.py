"""Limits on the polar command: small strategies, one after the other, each with a name.

A limit takes the command that is wanted and returns the one that may be given. A stop (v = omega =
0) passes all of them at once; what was moving begins again from rest.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, Annotated, NamedTuple, Protocol

from agv_motion.motion.command.polar import STILL, PolarCommand
from agv_motion.motion.command.ramp import Ramp
from agv_motion.parameters import Spec, check
from agv_motion.planar import wrap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.motion.command.floor_rules import FloorRules


@dataclass(frozen=True)
class LimitParameters:
    """How fast the command may change; 0 is no limit.

    A quarter turn of the heading in 6 s is what the turrets of the original installation did.
    """

    v_rate: Annotated[float, Spec('change of v; 0: no limit', '1/s', (0.0, 1e3))] = 0.0
    theta_rate: Annotated[
        float,
        Spec('change of heading while moving; 0: no limit', 'rad/s', (0.0, 1e3)),
    ] = 0.0
    omega_rate: Annotated[float, Spec('change of omega; 0: no limit', '1/s', (0.0, 1e3))] = 0.0
    v_jerk: Annotated[float, Spec('change of the rate of v; 0: no limit', '1/s2', (0.0, 1e4))] = 0.0
    omega_jerk: Annotated[
        float, Spec('change of the rate of omega; 0: no limit', '1/s2', (0.0, 1e4))
    ] = 0.0
    minimum: Annotated[
        float,
        Spec(
            'v or omega below which the motors stick: raised to it, or still below half of it',
            '1',
            (0.0, 1.0),
        ),
    ] = 0.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class CommandLimit(Protocol):
    """One limit; it may remember the last command it has given."""

    name: str

    def apply(self, wanted: PolarCommand, rules: FloorRules, dt: float) -> PolarCommand:
        """Return the command nearest to ``wanted`` that the limit allows ``dt`` [s] later."""

    def stop(self) -> None:
        """Note that the platform stands."""


class Limited(NamedTuple):
    """A command that may be given, and what made it differ from the wanted one."""

    command: PolarCommand
    by: tuple[str, ...]
    """names of the limits in force"""


STOP = Limited(STILL, ())


class CommandLimits:
    """All limits, in their order."""

    def __init__(self, limits: Sequence[CommandLimit]) -> None:
        """Start at rest."""
        self._limits = limits
        self._last = STILL

    @classmethod
    def of(cls, given: LimitParameters) -> CommandLimits:
        """Return the limits that parameters ask for."""
        limits: list[CommandLimit] = [MinimumSpeed(given.minimum)] if given.minimum else []
        limits += [SlowPlace(), TranslationOnly()]
        if given.v_rate:
            limits.append(VRate(given.v_rate, given.v_jerk or inf))
        if given.omega_rate:
            limits.append(OmegaRate(given.omega_rate, given.omega_jerk or inf))
        if given.theta_rate:
            limits.append(ThetaRate(given.theta_rate))
        return cls(limits)

    def apply(self, wanted: PolarCommand, rules: FloorRules, dt: float) -> Limited:
        """Return what may be commanded ``dt`` [s] after the last command.

        A command without v says nothing of the heading: the last one holds while v goes down.
        """
        if wanted.v == 0.0 == wanted.omega:
            return self.stop()
        if wanted.v == 0.0:
            wanted = wanted._replace(theta=self._last.theta)
        command, by = wanted, []
        for limit in self._limits:
            allowed = limit.apply(command, rules, dt)
            if allowed is not command and allowed != command:
                by.append(limit.name)
            command = allowed
        self._last = command
        return Limited(command, tuple(by))

    def stop(self) -> Limited:
        """Return a stop, which no limit delays."""
        if self._last is not STILL:
            for limit in self._limits:
                limit.stop()
            self._last = STILL
        return STOP


class MinimumSpeed:
    """Motors stick below some speed: a command weaker than that is raised to it or dropped.

    It starts at the minimum and, once moving, stays there until less than half of it is asked for.
    """

    name = 'minimum speed'

    def __init__(self, minimum: float) -> None:
        """Start at rest; ``minimum`` is the weakest v or omega that moves the platform."""
        self._minimum = minimum
        self._moving = False

    def apply(self, wanted: PolarCommand, rules: FloorRules, dt: float) -> PolarCommand:  # noqa: ARG002 - not asked
        """Raise or drop; v and omega by the same factor, so the centre of rotation stays."""
        strength = max(wanted.v, abs(wanted.omega))
        self._moving = strength >= self._minimum * (0.5 if self._moving else 1.0)
        if not self._moving:
            return PolarCommand(0.0, wanted.theta, 0.0)
        if strength >= self._minimum:
            return wanted
        factor = self._minimum / strength
        return PolarCommand(wanted.v * factor, wanted.theta, wanted.omega * factor)

    def stop(self) -> None:
        """Start anew."""
        self._moving = False


class SlowPlace:
    """Slow where the place asks for it."""

    name = 'slow here'

    def apply(self, wanted: PolarCommand, rules: FloorRules, dt: float) -> PolarCommand:  # noqa: ARG002 - not asked
        """Cap v."""
        return wanted if wanted.v <= rules.top_speed else wanted._replace(v=rules.top_speed)

    def stop(self) -> None:
        """Remember nothing."""


class TranslationOnly:
    """No turning where the floor is delicate."""

    name = 'translation only'

    def apply(self, wanted: PolarCommand, rules: FloorRules, dt: float) -> PolarCommand:  # noqa: ARG002 - not asked
        """Take the rotation off."""
        return wanted if rules.may_turn else wanted._replace(omega=0.0)

    def stop(self) -> None:
        """Remember nothing."""


class VRate:
    """v changes no faster than its rate, nor its slope than the jerk."""

    name = 'rate of v'

    def __init__(self, rate: float, jerk: float = inf) -> None:
        """Start at rest; rate [1/s], jerk [1/s2]."""
        self._ramp = Ramp(rate, jerk)

    def apply(self, wanted: PolarCommand, rules: FloorRules, dt: float) -> PolarCommand:  # noqa: ARG002 - not asked
        """Follow v."""
        v = self._ramp.advance(wanted.v, dt)
        return wanted if v == wanted.v else PolarCommand(v, wanted.theta, wanted.omega)

    def stop(self) -> None:
        """Be at rest."""
        self._ramp.set(0.0)


class OmegaRate:
    """The rotation changes no faster than its rate, nor its slope than the jerk.

    Where turning is not allowed it has ended at once, and begins again from rest.
    """

    name = 'rate of omega'

    def __init__(self, rate: float, jerk: float = inf) -> None:
        """Start at rest; rate [1/s], jerk [1/s2]."""
        self._ramp = Ramp(rate, jerk)

    def apply(self, wanted: PolarCommand, rules: FloorRules, dt: float) -> PolarCommand:
        """Follow omega."""
        if not rules.may_turn:
            self._ramp.set(0.0)
            return wanted
        omega = self._ramp.advance(wanted.omega, dt)
        return wanted if omega == wanted.omega else PolarCommand(wanted.v, wanted.theta, omega)

    def stop(self) -> None:
        """Be at rest."""
        self._ramp.set(0.0)


class ThetaRate:
    """The heading turns no faster than its rate, the short way round, while the trunk moves.

    At standstill it may jump: nothing moves, and the turrets see to their own turning.
    """

    name = 'rate of theta'

    def __init__(self, rate: float) -> None:
        """Start at rest; rate [rad/s]."""
        self._ramp = Ramp(rate)
        self._moving = False

    def apply(self, wanted: PolarCommand, rules: FloorRules, dt: float) -> PolarCommand:  # noqa: ARG002 - not asked
        """Follow theta."""
        theta = wanted.theta
        if self._moving and theta != self._ramp.value:
            turn = wrap(theta - self._ramp.value)
            theta = wrap(self._ramp.advance(self._ramp.value + turn, dt))
            theta = wanted.theta if abs(wrap(theta - wanted.theta)) < ROUNDING else theta
        self._ramp.set(theta)
        self._moving = wanted.v > 0.0
        return wanted if theta == wanted.theta else PolarCommand(wanted.v, theta, wanted.omega)

    def stop(self) -> None:
        """Stand: the next heading may be any."""
        self._moving = False


ROUNDING = 1e-12
"""[rad] Headings nearer than this are the same."""
