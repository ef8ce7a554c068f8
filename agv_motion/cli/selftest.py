"""`agv selftest`: whether the build that is installed computes what a hand computes."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from math import atan2, hypot, inf, pi, radians, sqrt
from typing import NamedTuple

import typer

ROUNDING = 1e-12
"""[-] What a closed form may be off by, as a share of the value, or of 1 where that is smaller."""


class Comparison(NamedTuple):
    """What was computed beside what it must be."""

    what: str
    computed: float
    expected: float

    @property
    def holds(self) -> bool:
        """Whether both agree to rounding; NaN agrees with nothing."""
        return abs(self.computed - self.expected) <= ROUNDING * max(1.0, abs(self.expected))


def selftest() -> None:
    """Compute what has a closed form, and compare.

    Needs neither ROS nor files, and takes a second. Exit status 1 when anything differs.
    """
    found = [(room.__name__.strip('_'), comparison) for room in ROOMS for comparison in room()]
    for room, (what, computed, expected) in found:
        verdict = 'ok     ' if Comparison(what, computed, expected).holds else 'differs'
        typer.echo(f'{verdict} {room:10} {what:58} {computed:21.15g}  by hand {expected:.15g}')
    wrong = sum(not comparison.holds for _, comparison in found)
    if wrong:
        typer.echo(
            f'error: {wrong} of {len(found)} values differ: this build computes wrongly; install '
            'it anew, and tell python --version and pip freeze if it stays so',
            err=True,
        )
        sys.exit(1)
    typer.echo(f'all {len(found)} values as computed by hand')


def _planar() -> Iterator[Comparison]:
    from agv_motion.planar import Pose, Twist, integrate

    end = integrate(Pose(1.0, 2.0, pi / 2), Twist(0.5, 0.0, 0.25), 4.0 * pi)  # half a circle, r = 2
    yield Comparison('half a circle of 2 m to the left from (1, 2): x [m]', end.x, -3.0)
    yield Comparison('y [m]', end.y, 2.0)


def _probe() -> Iterator[Comparison]:
    from agv_motion.probe.granier import flow_index, flux_density

    yield Comparison("Granier's K of 16 K, zero flow at 20 K", flow_index(16.0, 20.0), 0.25)
    # 118.99e-6 * 0.25**1.231 by mpmath, 20 digits
    yield Comparison('its flux density [um/s]', 1e6 * flux_density(0.25), 21.59606446572055)


def _kinematics() -> Iterator[Comparison]:
    from agv_motion.kinematics.differential import DifferentialDrive
    from agv_motion.kinematics.omniwheels import OmniWheels
    from agv_motion.kinematics.turrets import Turrets, centre_of_rotation
    from agv_motion.planar import Twist

    tree = Turrets.from_polar([radians(-45), radians(45), pi], [1.18] * 3)
    command = tree.command(Twist(0.01, 0.0, 0.01))
    reach = 1.18 / sqrt(2.0)  # the first turret stands at (reach, -reach)
    yield Comparison(
        'angle of a turret on a bend [rad]',
        command.angle[0],
        atan2(0.01 * reach, 0.01 + 0.01 * reach),
    )
    yield Comparison('its speed [m/s]', command.speed[0], hypot(0.01 * reach, 0.01 + 0.01 * reach))
    centre = centre_of_rotation(Twist(0.02, 0.01, 0.04)) or (inf, inf)
    yield Comparison('centre of rotation of (0.02, 0.01, 0.04): x [m]', centre[0], -0.25)
    yield Comparison('y [m]', centre[1], 0.5)
    omni = OmniWheels.from_polar([radians(30), radians(150), radians(270)], [0.2] * 3)
    speeds = omni.command(Twist(0.3, -0.1, 0.5)).speed
    by_hand = 0.5 * 0.3 + sqrt(0.75) * 0.1 - 0.2 * 0.5
    yield Comparison('an omni wheel at 30 deg [m/s]', speeds[0], by_hand)
    yield Comparison('and back: turn rate [rad/s]', omni.twist(speeds).twist.wz, 0.5)
    pair = DifferentialDrive(0.4, [0.1, 0.1]).command(Twist(0.3, 0.0, 0.5)).speed
    yield Comparison('wheels of a differential drive: left [m/s]', pair.left, 0.2)
    yield Comparison('right [m/s]', pair.right, 0.4)


def _trajectory() -> Iterator[Comparison]:
    from agv_motion.planar import Pose
    from agv_motion.trajectory.arc import Arc
    from agv_motion.trajectory.trapezoidal import trapezoid

    yield Comparison(
        '2 m at 0.5 m/s, ramps of 0.25 m/s2 [s]', trapezoid(2.0, 0.5, 0.25).duration, 6.0
    )
    end = Arc(pi / 2, 1.0, 0.4, 0.3, 0.3).end(Pose(0.0, 0.0, 0.0))
    yield Comparison('a quarter to the left, inner wheel on 1 m: x [m]', end.x, 0.7)
    yield Comparison('y [m]', end.y, 0.7)


ROOMS: tuple[Callable[[], Iterator[Comparison]], ...] = (_planar, _probe, _kinematics, _trajectory)
