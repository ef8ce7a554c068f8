"""The fastest that a robot may be told to move, whatever asks for it."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import Annotated

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check
from agv_motion.planar import Twist, require_finite

TRACKS = (0.001, 100.0)
"""[m]"""


@dataclass(frozen=True)
class TwistLimits:
    """Limits of speed: along the way, of a wheel, and of the turn."""

    track: float = 0.3
    """[m] between the wheels; no parameter of its own: the platform tells it"""
    wheel_speed: Annotated[float, Spec('fastest a wheel may roll', 'm/s', (0.001, 100.0))] = 1.0
    linear_speed: Annotated[
        float,
        Spec('fastest the robot may drive; its wheels limit it too', 'm/s', (0.001, 100.0)),
    ] = 100.0
    turn_rate: Annotated[float, Spec('fastest the robot may turn', 'rad/s', (0.001, 100.0))] = 2.0

    def __post_init__(self) -> None:
        """Check every row, and the track."""
        check(self)
        if not TRACKS[0] <= self.track <= TRACKS[1]:
            msg = (
                f'track = {self.track}: must lie in [{TRACKS[0]:g}, {TRACKS[1]:g}] m (distance '
                'between the wheels)'
            )
            raise ConfigurationError(msg)

    def hold(self, twist: Twist) -> Twist:
        r"""Return ``twist``, all of it slower by one factor where a part of it is too fast.

        So its direction and its centre of rotation stay. A wheel half a track from the middle rolls
        at :math:`|v| + |\omega| b / 2` at most, of a drive with two wheels or with omni wheels.

        Raises:
            SignalError: A number is not finite.

        """
        require_finite('twist', twist)
        linear, turn = hypot(twist.vx, twist.vy), abs(twist.wz)
        excess = max(
            linear / self.linear_speed,
            turn / self.turn_rate,
            (linear + 0.5 * self.track * turn) / self.wheel_speed,
        )
        if excess <= 1.0:
            return twist
        return Twist(twist.vx / excess, twist.vy / excess, twist.wz / excess)
