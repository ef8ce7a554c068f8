"""How far a platform may roll while its turrets are not yet where they should be."""

from __future__ import annotations

from math import cos, isnan, pi
from typing import TYPE_CHECKING

from agv_motion.planar import wrap

if TYPE_CHECKING:
    from collections.abc import Sequence


def rolling_share(angles: Sequence[float], measured: Sequence[float]) -> float:
    """Return the share of its speed with which a platform may roll while its turrets still turn.

    The cosine of the worst error, 0 from a quarter turn on and where one is NaN: all wheels slow
    down by one factor, so a platform at rest steers before it rolls, and turrets under way hardly
    pull against each other.

    Args:
        angles: (n,) commanded steering angles [rad].
        measured: (n,) angles as they are [rad].

    """
    worst = 0.0
    for a, b in zip(angles, measured, strict=True):
        error = abs(a - b)
        if error > pi:
            error = abs(wrap(a - b))
        if not error <= worst:
            if isnan(error):
                return 0.0
            worst = error
    return max(cos(worst), 0.0)
