"""Driven wheels as joints: which number of a JointState belongs to which wheel."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from sensor_msgs.msg import JointState

from agv_motion.errors import SignalError
from agv_motion.planar import require_finite

if TYPE_CHECKING:
    from collections.abc import Sequence


class WheelState(NamedTuple):
    """What was measured of each wheel; None for those that the message does not name."""

    angles: list[float | None]
    """(n,) [rad]; empty where the message has no positions"""
    rates: list[float | None]
    """(n,) [rad/s]; empty where it has no velocities"""


class WheelJoints:
    """The names of the joints of all wheels, in the order of the wheels."""

    def __init__(self, names: Sequence[str]) -> None:
        """Keep the names."""
        self.names = list(names)

    def message(self, rates: Sequence[float]) -> JointState:
        """Return a message of one velocity a wheel: [rad/s] at its axle, [m/s] of a roller."""
        return JointState(name=self.names, velocity=rates)

    def read(self, message: JointState) -> WheelState:
        """Return angles and rates, whatever the order of the joints; other joints pass by.

        Raises:
            SignalError: None of the joints is there, the arrays do not fit the names, there is
                neither position nor velocity, or a value is not finite.

        """
        names = list(message.name)
        if names == self.names:
            places: list[int | None] = list(range(len(names)))
        else:
            index = {name: i for i, name in enumerate(names)}
            places = [index.get(name) for name in self.names]
        if all(place is None for place in places):
            msg = f'joints {names}: expected {self.names}; name them so, or set joint_names'
            raise SignalError(msg)
        if not message.position and not message.velocity:
            msg = 'neither positions nor velocities: give each angle [rad] or each rate'
            raise SignalError(msg)
        return WheelState(
            _picked('positions', message.position, names, places),
            _picked('velocities', message.velocity, names, places),
        )


def _picked(
    field: str, values: Sequence[float], names: Sequence[str], places: Sequence[int | None]
) -> list[float | None]:
    if not values:
        return []
    if len(values) != len(names):
        msg = f'{len(values)} {field} for {len(names)} joints: give one each, or none'
        raise SignalError(msg)
    picked = [None if place is None else values[place] for place in places]
    require_finite(field, tuple(value for value in picked if value is not None))
    return picked
