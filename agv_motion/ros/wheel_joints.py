"""Driven wheels as joints: which number of a JointState belongs to which wheel."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING, NamedTuple

from sensor_msgs.msg import JointState

from agv_motion.errors import SignalError

if TYPE_CHECKING:
    from collections.abc import Sequence


class WheelState(NamedTuple):
    """What was measured of each wheel; None for those that the message does not name."""

    angles: list[float | None]
    """(n,) [rad]; empty where the message has no positions of use"""
    rates: list[float | None]
    """(n,) [rad/s]; empty where it has no velocities of use"""
    wrong: str
    """What was left out, and why; empty when all is well"""


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

        A value that is not finite, and an array that does not fit the names, is left out: the other
        field may tell the same wheel's motion. The effort is not looked at.

        Raises:
            SignalError: None of the joints is there, or nothing of use is told of any.

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
        angles, wrong_angles = _picked('positions', message.position, names, places)
        rates, wrong_rates = _picked('velocities', message.velocity, names, places)
        wrong = '; '.join(filter(None, (wrong_angles, wrong_rates)))
        if not angles and not rates:
            msg = f'neither positions nor velocities of use: {wrong or "give angles or rates"}'
            raise SignalError(msg)
        return WheelState(angles, rates, wrong)


def _picked(
    field: str, values: Sequence[float], names: Sequence[str], places: Sequence[int | None]
) -> tuple[list[float | None], str]:
    """Return the value of each wheel, None where it is of no use; and what is wrong with them."""
    if not values:
        return [], ''
    if len(values) != len(names):
        return [], f'{len(values)} {field} for {len(names)} joints: give one each, or none'
    picked = [None if place is None else values[place] for place in places]
    if isfinite(sum(value for value in picked if value is not None)):
        return picked, ''
    sound = [None if value is None or not isfinite(value) else value for value in picked]
    wrong = tuple(value for value in picked if value is not None)
    return (sound if any(v is not None for v in sound) else []), (
        f'{field} must be finite, got {wrong}'
    )
