"""What shapes the drive along a route: the virtual point, the profiles, the couplings."""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees, pi, sin
from typing import Annotated, NamedTuple

import numpy as np

from agv_motion.parameters import Spec, check
from agv_motion.route.coupling import CouplingForm
from agv_motion.route.table import ProfileTable

HALF_TURN = pi + 1e-4
"""[rad] Largest angle of a table: half a turn, as people round it up."""


class Profiles(NamedTuple):
    """The five tables."""

    omega_dphi: ProfileTable
    """turn rate [rad/s] over the angle between heading and virtual point [rad]"""
    v_dphi: ProfileTable
    """speed [m/s] over the same angle"""
    v_dn: ProfileTable
    """speed over the distance from the virtual point to the next waypoint [m]"""
    v_alpha: ProfileTable
    """speed over the angle between this segment and the next [rad]; pi is straight on"""
    v_d: ProfileTable
    """speed over the route still to go [m]"""

    def top_speed(self) -> float:
        """Return the highest speed [m/s] that the tables together ever allow."""
        corner = max(*self.v_dn.y, *self.v_alpha.y)
        return min(corner, max(self.v_dphi.y), max(self.v_d.y))


@dataclass(frozen=True)
class FollowParameters:
    """Every table holds x0, y0, x1, y1 ...: straight lines between, constant outside."""

    virtual_point_distance: Annotated[
        float,
        Spec(
            'dp, from the robot to the virtual point: larger is smoother',
            'm',
            (1e-3, 100),
            dynamic=True,
        ),
    ] = 0.4
    omega_dphi: Annotated[
        tuple[float, ...],
        Spec(
            'turn rate over |dphi|, the angle from heading to virtual point',
            'rad, rad/s',
            dynamic=True,
        ),
    ] = (0.0, 0.0, 0.5, 0.8, 1.6, 1.2)
    v_dphi: Annotated[
        tuple[float, ...],
        Spec('speed over |dphi|: slow when looking elsewhere', 'rad, m/s', dynamic=True),
    ] = (0.1, 0.5, 0.6, 0.2, 1.6, 0.02)
    v_dn: Annotated[
        tuple[float, ...],
        Spec(
            'speed over dn, from virtual point to next waypoint: slow at it', 'm, m/s', dynamic=True
        ),
    ] = (0.0, 0.12, 0.1, 0.25, 0.4, 0.5)
    v_alpha: Annotated[
        tuple[float, ...],
        Spec(
            'speed over alpha, from this segment to the next: pi straight, 0 hairpin',
            'rad, m/s',
            dynamic=True,
        ),
    ] = (1.5, 0.12, 3.0, 0.5)
    v_d: Annotated[
        tuple[float, ...],
        Spec('speed over d, the route still to go; 0 at 0', 'm, m/s', dynamic=True),
    ] = (0.0, 0.0, 0.05, 0.06, 0.15, 0.2, 0.5, 0.5)
    arrival_speed: Annotated[
        float,
        Spec(
            'arrived where v_d is not above; 0: only where v_d is 0',
            'm/s',
            (0.0, 1.0),
            dynamic=True,
        ),
    ] = 0.01
    speed_coupling_ms: Annotated[
        float,
        Spec(
            'time in which the speed joins its target, after each waypoint',
            'ms',
            (0, 6e4),
            dynamic=True,
        ),
    ] = 300.0
    turn_coupling_ms: Annotated[
        float, Spec('the same for the turn rate', 'ms', (0.0, 60000.0), dynamic=True)
    ] = 100.0
    coupling_form: Annotated[
        str,
        Spec(
            'the same at any rate, or by the tick, or as the original has it',
            choices=tuple(form.value for form in CouplingForm),
            dynamic=True,
        ),
    ] = CouplingForm.CORRECTED.value
    holonomic: Annotated[
        bool,
        Spec(
            'drive straight at the virtual point, whatever the heading (omni, turrets)',
            dynamic=True,
        ),
    ] = False

    def __post_init__(self) -> None:
        """Check every row and every table."""
        check(self)
        self.profiles()

    def profiles(self) -> Profiles:
        """Return the tables.

        Raises:
            ConfigurationError: A table is malformed or would stall the robot.

        """
        return Profiles(
            ProfileTable('omega_dphi', self.omega_dphi, HALF_TURN).require_zero_at_zero(
                'the robot would swing to and fro about the virtual point'
            ),
            ProfileTable('v_dphi', self.v_dphi, HALF_TURN).require_positive(),
            ProfileTable('v_dn', self.v_dn).require_positive(),
            ProfileTable('v_alpha', self.v_alpha, HALF_TURN).require_positive(),
            ProfileTable('v_d', self.v_d)
            .require_zero_at_zero('the robot would never arrive')
            .require_above_for_good(self.arrival_speed),
        )

    def orbit(self) -> str:
        r"""Return a warning if a differential robot could circle for ever round a waiting point.

        At a distance D it closes in while it looks less than a quarter turn away from the point,
        and it turns towards it if :math:`\omega(\varphi) > v(\varphi) \sin\varphi / D`. Both fail
        on a circle of that radius, and from D = dp on the point waits. Empty if this cannot be.
        """
        profiles = self.profiles()
        for angle in np.linspace(pi / 2.0, pi, 91).tolist():
            speed, turn = profiles.v_dphi(angle), profiles.omega_dphi(angle)
            if not self.holonomic and turn * self.virtual_point_distance <= speed * sin(angle):
                return (
                    f'at dphi = {degrees(angle):.0f} deg the tables give {speed:.3g} m/s and '
                    f'{turn:.3g} rad/s: the robot could circle for ever round a virtual point '
                    f'that waits {self.virtual_point_distance:g} m away; lower v_dphi or raise '
                    'omega_dphi there'
                )
        return ''
