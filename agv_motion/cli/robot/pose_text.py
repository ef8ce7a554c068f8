"""A pose as people type it: X,Y,DEGREES."""

from __future__ import annotations

from math import isfinite, radians

from agv_motion.errors import ConfigurationError
from agv_motion.planar import Pose, wrap


def parse_pose(option: str, text: str) -> Pose:
    """Return the pose that was typed behind ``option``.

    Raises:
        ConfigurationError: It is not three finite numbers.

    """
    try:
        x, y, degrees = map(float, text.split(','))
    except ValueError:
        x = y = degrees = float('nan')
    if not isfinite(x + y + degrees):
        msg = f'{option} {text}: give X,Y,DEGREES, such as 0,0.5,90'
        raise ConfigurationError(msg)
    return Pose(x, y, wrap(radians(degrees)))
