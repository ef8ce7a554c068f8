"""From the angles that a twist asks for to angles that real turrets can follow."""

from __future__ import annotations

from math import cos, pi
from typing import TYPE_CHECKING

from agv_motion.planar import wrap

if TYPE_CHECKING:
    from collections.abc import Sequence


def nearest_turns(angles: Sequence[float], held: Sequence[float]) -> list[float]:
    """Return each angle in the turn nearest to where its turret stands: no jump across pi.

    Args:
        angles: (n,) wanted steering angles [rad].
        held: (n,) present steering angles, in any turn [rad].

    """
    return [
        angle if -pi <= angle - now < pi else now + wrap(angle - now)
        for angle, now in zip(angles, held)  # noqa: B905 - measured: strict costs
    ]


def alignment(angles: Sequence[float], measured: Sequence[float]) -> float:
    """Return the share of its speed with which a platform may roll while its turrets still turn.

    The cosine of the worst error, 0 from a quarter turn on: all wheels slow down by one factor, so
    a platform at rest steers before it rolls, and turrets under way hardly pull against each
    other.

    Args:
        angles: (n,) commanded steering angles [rad].
        measured: (n,) angles as they are [rad].

    """
    worst = max(abs(wrap(a - b)) for a, b in zip(angles, measured, strict=True))
    return max(cos(worst), 0.0)
