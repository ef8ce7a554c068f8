"""What `wheel_kinematics` makes of `turrets/state`: `turrets/residual` and `odom`.

Over a recording many states are reckoned together by columns, to the bit the same.
"""

from __future__ import annotations

from math import cos, sin
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

from agv_motion.bag.cdr.message_rows import MessageRows
from agv_motion.errors import SignalError
from agv_motion.kinematics.elementwise import elementwise
from agv_motion.kinematics.turrets import Turrets
from agv_motion.odometry.turret_odometry import TurretOdometry
from agv_motion.ros.cdr import codec
from agv_motion.ros.covariances import fill_covariance
from agv_motion.ros.messages import fill_pose, fill_twist, seconds_of, type_name
from agv_motion.ros.port import Ahead
from agv_motion.ros.qos import SENSOR
from agv_motion.ros.twist_rows import PLANAR

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from agv_motion.nodes.steering_parameters import WheelKinematicsParameters
    from agv_motion.odometry.turret_odometry import ReckonedColumns
    from agv_motion.ros.input_watch import InputWatch
    from agv_motion.ros.messages import TurretJoints
    from agv_motion.ros.port import Port

SECOND = 1_000_000_000


class Judge(Protocol):
    """Who looks at what the turrets tell."""

    def note_angles(self, angles: list[float]) -> None:
        """Take up the steering angles of a state that is news [rad].

        Raises:
            SignalError: One is no angle of a turret.

        """

    def note_residual(self, residual: float) -> None:
        """Take up how hard the turrets pull against each other [m/s]."""


class _State(NamedTuple):
    """What a state tells that was reckoned beforehand, and the messages that it leads to."""

    taken: int
    """stamp [ns]"""
    angles: list[float]
    residual: float
    fight: bytes
    odometry: bytes


class TurretStates:
    """Fits the twist that the turrets really make, and carries the odometry on."""

    def __init__(
        self, port: Port, given: WheelKinematicsParameters, joints: TurretJoints, judge: Judge,
        watch: InputWatch,
    ) -> None:  # fmt: skip
        """Open the topics.

        Args:
            port: Of the node.
            given: Its parameters.
            joints: Names of the turrets.
            judge: Told of each state that is of use.
            watch: Of the input.

        """
        self._port, self._joints, self._judge, self._watch = port, joints, judge, watch
        self._radius, self._zero = given.wheel_radius, given.zeros()
        self._reckoning = TurretOdometry(
            Turrets.of(given), given.wheel_noise, given.max_measured_speed, given.max_gap
        )
        self.fastest = 0.0
        """How fast the fastest wheel was seen to roll [m/s]"""
        self._message = Odometry(child_frame_id=given.base_frame)
        self._message.header.frame_id = given.odom_frame
        self._fight = port.publisher(Float64, 'turrets/residual', SENSOR)
        self._odometry = port.publisher(Odometry, 'odom', SENSOR, sole=True)
        self._columns = _Columns(self._message)
        ahead = Ahead(self._prepare, self._take)
        port.listen_ahead(JointState, 'turrets/state', self._on_state, ahead, SENSOR)
        port.need('turrets/state')

    def _on_state(self, message: JointState) -> None:
        """Take a state; one that does not follow the last, see `continuity`, is no news."""
        state, radius, stamp = self._joints.read_state(message), self._radius, message.header.stamp
        news = self._watch.is_news(stamp)
        angles = [angle + zero for angle, zero in zip(state.angles, self._zero, strict=True)]
        speeds = [rate * radius for rate in state.rates]
        rolled = [angle * radius for angle in state.turned]
        reckoned = self._reckoning.update(seconds_of(stamp), angles, speeds, rolled)
        if state.wrong:
            self._port.refuse(f'turrets/state: {state.wrong}; going by the angles of the wheels')
        if not reckoned.step.used:
            return
        self.fastest = max(map(abs, speeds))
        if news:
            self._judge.note_angles(angles)
        odometry = self._message
        odometry.header.stamp = stamp
        fill_pose(odometry.pose.pose, reckoned.pose)
        fill_covariance(odometry.pose.covariance, reckoned.covariance)
        fill_twist(odometry.twist.twist, reckoned.twist)
        self._tell(reckoned.residual, Float64(data=reckoned.residual), odometry)

    def _tell(self, residual: float, fight: Float64 | bytes, odometry: Odometry | bytes) -> None:
        self._fight.publish(fight)
        self._judge.note_residual(residual)
        self._odometry.publish(odometry)

    # Many states together

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
        speeds = (velocities[:, wheel] * self._radius).T
        if not (np.isfinite(angles).all() and np.isfinite(speeds).all()):
            return []
        return self._reckon(table, np.array(stamps, np.int64), angles, speeds)

    def _reckon(
        self, states: NDArray[Any], stamps: NDArray[np.int64],
        angles: NDArray[np.float64], speeds: NDArray[np.float64],
    ) -> list[_State]:  # fmt: skip
        """Return the states that will come at ``stamps``; none unless all are news and of use."""
        sec, nanosec = states['header.stamp.sec'], states['header.stamp.nanosec']
        taken = sec.astype(np.int64) * SECOND + nanosec
        times = sec + nanosec * 1e-9
        if not (self._watch.are_news(taken, stamps) and self._reckoning.are_plain(times, speeds)):
            return []
        reckoned = self._reckoning.update_columns(times, angles, speeds)
        return list(
            map(
                _State,
                taken.tolist(),
                angles.T.tolist(),
                reckoned.residual.tolist(),
                self._columns.fights(reckoned.residual),
                self._columns.odometries(sec, nanosec, reckoned),
            )
        )

    def _take(self, state: _State) -> None:
        self._watch.newest = state.taken
        self._judge.note_angles(state.angles)
        self._tell(state.residual, state.fight, state.odometry)


class _Columns:
    """Makes the messages of many states together."""

    def __init__(self, odometry: Odometry) -> None:
        self._fights, self._odometries = _rows(Float64()), _rows(odometry)

    def fights(self, residuals: NDArray[np.float64]) -> Sequence[bytes]:
        """Return one message for each residual [m/s]."""
        table = self._fights.table(len(residuals))
        table['data'] = residuals
        return self._fights.messages(table)

    def odometries(
        self, sec: NDArray[Any], nanosec: NDArray[Any], reckoned: ReckonedColumns
    ) -> Sequence[bytes]:
        """Return one message for each state, of the time at which it was taken."""
        table = self._odometries.table(len(sec))
        table['header.stamp.sec'], table['header.stamp.nanosec'] = sec, nanosec
        x, y, heading = reckoned.pose
        table['pose.pose.position.x'], table['pose.pose.position.y'] = x, y
        table['pose.pose.orientation.z'] = elementwise(sin, heading / 2.0)
        table['pose.pose.orientation.w'] = elementwise(cos, heading / 2.0)
        fill_covariance(table['pose.covariance'].T, reckoned.covariance)
        for axis, column in zip(PLANAR, reckoned.twist, strict=True):
            table[f'twist.twist.{axis}'] = column
        return self._odometries.messages(table)


def _rows(example: Any) -> MessageRows:
    kind: Any = type(example)
    return MessageRows(type_name(kind), codec(kind).encode(example))
