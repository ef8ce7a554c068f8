"""What some nodes do otherwise on a recording: take its readings, and take many rows at once."""

from __future__ import annotations

from functools import partial
from math import cos, sin
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from sensor_msgs.msg import JointState, Temperature
from std_msgs.msg import Float64

from agv_motion.bag.message_rows import MessageRows
from agv_motion.errors import SignalError
from agv_motion.kinematics.elementwise import elementwise
from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.planar import Twist
from agv_motion.probe.sources.recorded import RecordedSource
from agv_motion.ros.cdr import codec
from agv_motion.ros.covariances import fill_covariance
from agv_motion.ros.messages import seconds_of, stamp_of, type_name
from agv_motion.ros.qos import SENSOR

if TYPE_CHECKING:
    from collections.abc import Callable

    from geometry_msgs.msg import TwistStamped
    from numpy.typing import NDArray

    from agv_motion.odometry.turret_odometry import ReckonedColumns
    from agv_motion.ros.world import Listener

SECOND = 1_000_000_000
TWIST = ('linear.x', 'linear.y', 'angular.z')
"""The planar part of a geometry_msgs/Twist."""


class RecordedProbe(GranierProbe):
    """The probe node on its recorded readings; its source is asked only for what came before."""

    def open(self) -> None:
        """Open as live, then listen to the recording in place of the source."""
        super().open()
        probes = self.parameters.probes()
        recorded = self._source = RecordedSource(self._source, probes)
        for i in range(probes):
            self.listen(
                Temperature, f'granier/probe_{i + 1}/temperature_difference',
                partial(_take, recorded, i), SENSOR,
            )  # fmt: skip

    def _on_sunlight(self, _: Any) -> None:
        """Leave it: the readings are known."""


def _take(recorded: RecordedSource, probe: int, message: Temperature) -> None:
    recorded.take(probe, seconds_of(message.header.stamp), message.temperature)


class RecordedMotion(MotionGenerator):
    """The motion node; its twists become messages many together."""

    def open(self) -> None:
        """Open as live, then tell how twists become messages."""
        super().open()
        self._rows_out: Any = self._command.topic  # of the world
        if self._command.stamped:
            self._twists = _rows(self._command.message)
            self._rows_out.together = self._messages

    def _tell_twist(self, twist: Twist) -> None:
        if not self._rows_out.publish_row(twist):
            super()._tell_twist(twist)

    def _messages(self, stamps: NDArray[np.int64], twists: list[Any]) -> list[bytes]:
        table = self._twists.table(len(twists))
        _stamp(table, stamps)
        for axis, column in zip(TWIST, np.array(twists).reshape(-1, 3).T, strict=True):
            table[f'twist.{axis}'] = column
        return self._twists.messages(table)


class _State(NamedTuple):
    """What a recorded state of the turrets tells, and the messages that it leads to."""

    taken: int
    """stamp [ns]"""
    angles: list[float]
    residual: float
    fight: bytes
    odometry: bytes


class RecordedWheels(WheelKinematics):
    """The wheel node; it reckons many states together by columns, to the bit the same."""

    listener: Callable[[str], Listener]

    def open(self) -> None:
        """Open as live, then ask for the states many together."""
        super().open()
        self._fights, self._odometries = _rows(Float64()), _rows(self._odometry_message)
        self._joints.fill(self._message, self._zero, self._zero)
        self._commands = _rows(self._message)
        self._command.together = self._messages
        self.listener('cmd_vel').takes_rows = self.parameters.stamped
        self.listener('turrets/state').prepare = self._prepare

    def _on_stamped_twist(self, message: TwistStamped | Twist) -> None:
        if isinstance(message, Twist):
            now = stamp_of(self.nanoseconds())
            self._take_twist(message, self.parameters.base_frame, now)
        else:
            super()._on_stamped_twist(message)

    def _tell_turrets(self, angles: list[float], rates: list[float]) -> None:
        if not self._command.publish_row((angles, rates)):
            super()._tell_turrets(angles, rates)

    def _messages(self, stamps: NDArray[np.int64], commands: list[Any]) -> list[bytes]:
        table = self._commands.table(len(commands))
        _stamp(table, stamps)
        angles, rates = np.array(commands).reshape(len(commands), 2, -1).transpose(1, 0, 2)
        table['position'][:, : angles.shape[1]] = angles
        table['velocity'][:, angles.shape[1] :] = rates
        return self._commands.messages(table)

    def _prepare(self, messages: list[bytes], stamps: list[int]) -> list[_State]:
        """Return what the states tell; none unless all are alike, news and of use."""
        try:
            names = codec(JointState).decode(messages[0]).name
            steering, wheel = self._joints.places(names)
            table = MessageRows(type_name(JointState), messages[0]).read(messages)
        except (SignalError, ValueError):
            return []
        if table is None or not {'position', 'velocity'} <= set(table.dtype.names or ()):
            return []
        positions, velocities = table['position'], table['velocity']
        if not positions.shape == velocities.shape == (len(messages), len(names)):
            return []
        angles = (positions[:, steering] + np.array(self._zero)).T
        speeds = (velocities[:, wheel] * self.parameters.wheel_radius).T
        if not (np.isfinite(angles).all() and np.isfinite(speeds).all()):
            return []
        sec, nanosec = table['header.stamp.sec'], table['header.stamp.nanosec']
        taken = sec.astype(np.int64) * SECOND + nanosec
        times = sec + nanosec * 1e-9
        news = self._state_watch.are_news(taken, np.array(stamps, np.int64))
        if not news or not self._reckoning.are_plain(times, speeds):
            return []
        reckoned = self._reckoning.update_columns(times, angles, speeds)
        fights = self._fights.table(len(messages))
        fights['data'] = reckoned.residual
        return list(
            map(
                _State,
                taken.tolist(),
                angles.T.tolist(),
                reckoned.residual.tolist(),
                self._fights.messages(fights),
                self._odometries.messages(self._odometry_table(table, reckoned)),
            )
        )

    def _odometry_table(self, states: NDArray[Any], reckoned: ReckonedColumns) -> NDArray[Any]:
        table = self._odometries.table(len(states))
        for part in ('header.stamp.sec', 'header.stamp.nanosec'):
            table[part] = states[part]
        x, y, heading = reckoned.pose
        table['pose.pose.position.x'], table['pose.pose.position.y'] = x, y
        table['pose.pose.orientation.z'] = elementwise(sin, heading / 2.0)
        table['pose.pose.orientation.w'] = elementwise(cos, heading / 2.0)
        fill_covariance(table['pose.covariance'].T, reckoned.covariance)
        for axis, column in zip(TWIST, reckoned.twist, strict=True):
            table[f'twist.twist.{axis}'] = column
        return table

    def _on_state(self, message: JointState | _State) -> None:
        if not isinstance(message, _State):
            super()._on_state(message)
            return
        self._state_watch.newest = message.taken
        self._note_angles(message.angles)
        self._fight.publish(message.fight)
        self._judge_residual(message.residual)
        self._odometry.publish(message.odometry)


def _rows(example: Any) -> MessageRows:
    kind: Any = type(example)
    return MessageRows(type_name(kind), codec(kind).encode(example))


def _stamp(table: NDArray[Any], nanoseconds: NDArray[np.int64]) -> None:
    table['header.stamp.sec'], table['header.stamp.nanosec'] = np.divmod(nanoseconds, SECOND)


RECORDED: dict[str, Any] = {
    'granier_probe': RecordedProbe,
    'motion_generator': RecordedMotion,
    'wheel_kinematics': RecordedWheels,
}
"""Nodes that are others on a recording, by name."""
