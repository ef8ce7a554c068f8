"""A seeded trial of the steering planner on a random platform, every limit measured on the way."""

from __future__ import annotations

import random
from math import cos, pi, sin
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.kinematics.steering.planner import SteeringPlanner
from agv_motion.kinematics.steering.state import AtRest
from agv_motion.kinematics.turrets import Turrets
from agv_motion.planar import Twist

if TYPE_CHECKING:
    from agv_motion.kinematics.steering.state import Phase


class Worst(NamedTuple):
    """The most that was seen of each quantity, as a share of its limit."""

    steering_rate: float
    steering_acceleration: float
    wheel_speed: float
    wheel_acceleration: float
    turn: float
    residual: float
    """of the least-squares ICR fit, as a share of the fastest wheel"""

    def with_(self, other: Worst) -> Worst:
        """Return the worst of both."""
        return Worst(*map(max, self, other))


class SteeringTrial:
    """Random platform, limits and commands from a seed."""

    def __init__(self, seed: int) -> None:
        """Draw 2 to 8 turrets anywhere, and motors from sluggish to brisk."""
        self.random = draw = random.Random(seed)  # noqa: S311 - a trial, no secret
        count = draw.choice([2, 3, 3, 4, 4, 6, 8])
        self.turrets = Turrets(
            [(draw.uniform(-1.5, 1.5), draw.uniform(-1.5, 1.5)) for _ in range(count)]
        )
        rate = draw.uniform(0.1, 6.0)
        self.limits = SteeringLimits(
            max_wheel_speed=draw.uniform(0.03, 2.0),
            wheel_acceleration=draw.uniform(0.3, 3.0),
            steering_rate=rate,
            steering_acceleration=rate * rate * draw.uniform(0.5, 20.0),
            turn_limit=draw.uniform(0.4, 3.0),
            reversal_angle=draw.uniform(pi / 2, pi),
        )
        self.planner = SteeringPlanner(self.turrets, self.limits)
        most = self.limits.cables_end
        self.phase: Phase = AtRest.at([draw.uniform(-most, most) for _ in range(count)])
        self.period = draw.choice([0.01, 0.02, 0.05, 0.1])
        self._last = 0.0

    def twist(self, kind: str) -> Twist:
        """Draw a twist: any, or one that turns about a turret or nearly so."""
        draw, size = self.random, self.random.uniform(0.0, 1.5) * self.limits.max_wheel_speed
        if kind == 'zero':
            return Twist(0.0, 0.0, 0.0)
        if kind == 'about a turret':
            x, y = draw.choice(self.turrets.positions)
            wz = draw.choice([-size, size])
            off = draw.choice([0.0, 0.0, 1e-6, 1e-3, 0.03])
            return Twist(wz * (y + off), -wz * x, wz)
        return Twist(*(draw.gauss(0.0, 1.0) * size for _ in range(3)))

    def steps(self, count: int) -> Worst:
        """Run under commands that stay, jump, rattle, wander or stop; return what was worst."""
        draw, worst, left = self.random, Worst(*[0.0] * 6), 0
        kinds = 'steady', 'noisy', 'wandering', 'zero', 'about a turret'
        for k in range(count):
            if left <= 0:
                left, kind = 1 + int(draw.expovariate(1.0 / 60.0)), draw.choice(kinds)
                aim = wanted = self.twist(kind)
            left -= 1
            if kind == 'noisy':
                wanted = Twist(*(c * (1.0 + draw.gauss(0.0, 0.2)) for c in aim))
            elif kind == 'wandering':
                c, s = cos(0.01 * k), sin(0.01 * k)
                wanted = Twist(aim.vx * c - aim.vy * s, aim.vx * s + aim.vy * c, aim.wz)
            worst = worst.with_(self.step(wanted, self.period * draw.uniform(0.7, 1.4)))
        return worst

    def step(self, wanted: Twist, period: float) -> Worst:
        """Take one step and measure it from outside, by differences."""
        before, limits = self.phase.setpoints, self.limits
        angles, rates, speeds = list(before.angles), list(before.rates), list(before.speeds)
        self.phase = self.planner.step(self.phase, wanted, period)
        made = self.phase.setpoints
        passed = min(period, 0.5 * (period + self._last)) if self._last else period
        self._last = period
        new_rates = [(b - a) / period for a, b in zip(angles, made.angles, strict=True)]
        fastest = max(map(abs, made.speeds))
        fit = self.turrets.twist(made.angles, made.speeds)
        return Worst(
            max(map(abs, new_rates)) / limits.steering_rate,
            _most_change(rates, new_rates) / passed / limits.steering_acceleration,
            fastest / limits.max_wheel_speed,
            _most_change(speeds, made.speeds) / period / limits.wheel_acceleration,
            max(map(abs, made.angles)) / limits.cables_end,
            fit.residual / fastest if fastest else 0.0,
        )

    def error(self, wanted: Twist) -> float:
        """Return how far the commanded twist is from the wanted one, scaled to what is feasible."""
        top = self.limits.max_wheel_speed
        scale = self.turrets.command(wanted, max_wheel_speed=top).scale
        made = self.phase.setpoints.twist(self.turrets)
        return max(abs(a - scale * b) for a, b in zip(made, wanted, strict=True))

    def settle(self, wanted: Twist, tolerance: float) -> float:
        """Hold ``wanted`` until it is made; return the time that took, beyond speeding up [s].

        Raises:
            AssertionError: It is never made.

        """
        brisk = 2.0 * self.limits.max_wheel_speed / self.limits.wheel_acceleration
        most = brisk + 40.0 / self.limits.steering_rate
        time = 0.0
        while self.error(wanted) > tolerance:
            self.phase = self.planner.step(self.phase, wanted, self.period)
            time += self.period
            assert time < most, f'{wanted} is not made within {most:.0f} s'
        return max(time - brisk, 0.0)


def _most_change(before: list[float], after: list[float]) -> float:
    return max(abs(b - a) for a, b in zip(before, after, strict=True))
