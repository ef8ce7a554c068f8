r"""The speed on a route as one pure function of four measures.

.. math:: V_p = \min(v(d\varphi), \max(v(d_n), v(\alpha))), \qquad V = \min(v(d), V_p)   \tag{1}
"""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from agv_motion.route.parameters import Profiles


class RouteLimiter(Enum):
    """What holds the speed down."""

    TO_GO = 'v(d)'
    HEADING = 'v(dphi)'
    WAYPOINT = 'v(dn)'
    BEND = 'v(alpha)'
    COUPLING = 'coupling'


class RouteSpeeds(NamedTuple):
    """What each table allows, and what comes of them."""

    v_d: float
    """[m/s]"""
    v_dphi: float
    """[m/s]"""
    v_dn: float
    """[m/s]"""
    v_alpha: float
    """[m/s]"""
    vp: float
    """Vp [m/s], without the braking at the end"""
    speed: float
    """V [m/s]"""
    limiter: RouteLimiter


def route_speeds(
    profiles: Profiles, heading_error: float, to_waypoint: float, bend: float, to_go: float
) -> RouteSpeeds:
    """Return Vp and V of equation (1), and which table is in force.

    Args:
        profiles: The tables.
        heading_error: dphi, from the heading to the virtual point, of either sign [rad].
        to_waypoint: dn, from the virtual point to the next waypoint [m].
        bend: alpha, between this segment and the next [rad]; pi is straight on.
        to_go: d, the route still to go [m].

    """
    v_d, v_dphi = profiles.v_d(to_go), profiles.v_dphi(abs(heading_error))
    v_dn, v_alpha = profiles.v_dn(to_waypoint), profiles.v_alpha(bend)
    corner = max(v_dn, v_alpha)
    vp = min(v_dphi, corner)
    if v_d <= vp:
        limiter = RouteLimiter.TO_GO
    elif v_dphi <= corner:
        limiter = RouteLimiter.HEADING
    else:
        limiter = RouteLimiter.WAYPOINT if v_dn > v_alpha else RouteLimiter.BEND
    return RouteSpeeds(v_d, v_dphi, v_dn, v_alpha, vp, min(v_d, vp), limiter)
