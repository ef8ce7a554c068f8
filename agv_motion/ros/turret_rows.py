"""Commands to the turrets as rows: the steering angles, and the rates of the wheels."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray
    from sensor_msgs.msg import JointState

    from agv_motion.ros.messages import TurretJoints

    Row = tuple[list[float], list[float]]


class TurretRows:
    """Angles [rad] and rates [rad/s] of all turrets as sensor_msgs/JointState."""

    def __init__(self, joints: TurretJoints, count: int, frame: str) -> None:
        """Tell the turrets, ``count`` of them, by the names of their ``joints``."""
        self._joints, self._zeros, self._frame = joints, [0.0] * count, frame

    def message(self) -> JointState:
        """Return a message of straight turrets that stand."""
        message = self._joints.message()
        message.header.frame_id = self._frame
        self._joints.fill(message, self._zeros, self._zeros)
        return message

    def fill(self, message: Any, row: Row) -> None:
        """Write a command into a message."""
        self._joints.fill(message, *row)

    def fill_table(self, table: NDArray[Any], rows: Sequence[Row]) -> None:
        """Write many commands into the columns of a table."""
        angles, rates = np.array(rows).reshape(len(rows), 2, -1).transpose(1, 0, 2)
        table['position'][:, : angles.shape[1]] = angles
        table['velocity'][:, angles.shape[1] :] = rates

    def read(self, message: Any) -> Row:
        """Return the command of a message; raise a `SignalError` where it is none."""
        return self._joints.read(message)
