"""Node `robot_model`: what the robot looks like, and how its joints stand, for tools that draw."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from math import isfinite
from typing import TYPE_CHECKING, Annotated, Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState
from std_msgs.msg import String

from agv_motion.errors import SignalError
from agv_motion.model.robot_transforms import RobotTransforms
from agv_motion.model.rolling import CountedWheels
from agv_motion.model.urdf import write_urdf
from agv_motion.nodes.platform_parameters import STEERING, Platform, RobotPlatformParameters
from agv_motion.parameters import Spec, check
from agv_motion.ros.diagnosis import OK, WARN, Diagnosis
from agv_motion.ros.messages import pose_of
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.qos import LATCHED, SENSOR
from agv_motion.ros.run import run
from agv_motion.ros.transforms import Transforms

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.ros.port import Port

HOLD = 3.0
"""[s] How long the place of `odom` in the map counts on /tf after the last pose"""
ON_TIME = 0.99
"""[-] Share of the period after which joints are told again: stamps are rounded."""


class ToldOnTf(Enum):
    """Which transforms are published live."""

    ALL = 'all'
    """From the map to the wheels"""
    JOINTS = 'joints'
    """From the base to the wheels"""
    NONE = 'none'


@dataclass(frozen=True)
class RobotModelParameters(RobotPlatformParameters):
    """What the robot stands on, and how often its joints are told."""

    rate: Annotated[
        float,
        Spec('joint_states, highest rate; 0: with each state of the wheels', 'Hz', (0, 1000)),
    ] = 0.0
    tf: Annotated[
        str,
        Spec(
            'transforms to publish where tf2_msgs is installed: all, or those of the joints where '
            'localization tells the others',
            choices=tuple(each.value for each in ToldOnTf),
        ),
    ] = ToldOnTf.JOINTS.value

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class RobotModelNode(PlainNode[RobotModelParameters]):
    """`turrets/state` or `wheels/state` -> `joint_states`, `robot_description`, /tf, /tf_static."""

    name = 'robot_model'
    takes = RobotModelParameters

    def __init__(self, port: Port, parameters: RobotModelParameters) -> None:
        """Build the model, and open the topics."""
        super().__init__(port, parameters)
        given, self._model = parameters, parameters.model()
        self._wheels = [name for name in self._model.moving if not name.endswith(STEERING)]
        self._counted = CountedWheels(len(self._wheels))
        self._told_at: int | None = None
        self._transforms = RobotTransforms(self._model, given.prefix, HOLD)
        tells = ToldOnTf(given.tf)
        one = tells is ToldOnTf.ALL  # else localization tells the others, and why there are none
        self._tf = None if tells is ToldOnTf.NONE else Transforms(port, static=True, complains=one)
        self._description = port.publisher(String, 'robot_description', LATCHED, sole=True)
        self._joints = port.publisher(JointState, 'joint_states', SENSOR, sole=True)
        topic = 'turrets/state' if given.platform == Platform.TREE.value else 'wheels/state'
        port.listen(JointState, topic, self._on_state, SENSOR)
        port.need(topic)
        if tells is ToldOnTf.ALL and self._tf is not None and self._tf.available:
            port.listen(Odometry, 'odom', self._on_odometry, SENSOR)
            port.listen(PoseWithCovarianceStamped, 'pose', self._on_pose, SENSOR)

    def begin(self) -> None:
        """Tell what the robot looks like."""
        self._description.publish(String(data=write_urdf(self._model)))
        if self._tf is not None:
            self._tf.tell_static(self._transforms.fixed(self.port.nanoseconds()))

    def diagnose(self) -> Diagnosis:
        """Tell whether the joints were heard of."""
        if self._told_at is None:
            return Diagnosis(WARN, 'no state of the wheels yet', {})
        return Diagnosis(OK, 'telling the joints', {'joints': str(len(self._model.moving))})

    def _on_state(self, message: JointState) -> None:
        """Tell the joints anew, the wheels by angles that really roll."""
        positions = _by_name('positions', message.name, message.position)
        rates = _by_name('velocities', message.name, message.velocity)
        stamp = message.header.stamp.sec * 10**9 + message.header.stamp.nanosec
        turned = self._counted.update(
            stamp,
            [positions[name] for name in self._wheels if name in positions],
            [rates[name] for name in self._wheels if name in rates],
        )
        if not self._is_due(stamp):
            return
        positions |= dict(zip(self._wheels, turned, strict=True))
        told = {name: positions[name] for name in self._model.moving if name in positions}
        joints = JointState(name=list(told), position=list(told.values()))
        joints.velocity = [rates.get(name, 0.0) for name in told]
        joints.header.stamp, joints.header.frame_id = message.header.stamp, self._base
        self._joints.publish(joints)
        if self._tf is not None:
            self._tf.tell(self._transforms.take_joints(stamp, told))

    @property
    def _base(self) -> str:
        return self.parameters.base_frame

    def _is_due(self, stamp: int) -> bool:
        """Return whether the joints are to be told at a ``stamp`` [ns], and note it."""
        rate, last = self.parameters.rate, self._told_at
        due = last is None or rate == 0.0 or abs(stamp - last) * 1e-9 * rate >= ON_TIME
        if due:
            self._told_at = stamp
        return due

    def _on_odometry(self, message: Odometry) -> None:
        header, given = message.header, self.parameters
        stamp = header.stamp.sec * 10**9 + header.stamp.nanosec
        frame, child = given.own(header.frame_id), given.own(message.child_frame_id)
        pose = pose_of(message.pose.pose)
        self._tell(self._transforms.take_odometry(stamp, frame, child, pose))

    def _on_pose(self, message: PoseWithCovarianceStamped) -> None:
        header = message.header
        stamp = header.stamp.sec * 10**9 + header.stamp.nanosec
        pose = pose_of(message.pose.pose)
        self._tell(self._transforms.take_pose(stamp, header.frame_id.lstrip('/'), pose))

    def _tell(self, transforms: Any) -> None:
        if self._tf is not None:
            self._tf.tell(transforms)


def _by_name(field: str, names: Sequence[str], values: Sequence[float]) -> dict[str, float]:
    """Return the values of joints by name, those that are not finite left out.

    Raises:
        SignalError: There are more or fewer values than joints.

    """
    if len(values) not in {0, len(names)}:
        msg = f'{len(values)} {field} for {len(names)} joints: give one each, or none'
        raise SignalError(msg)
    return {name: value for name, value in zip(names, values, strict=False) if isfinite(value)}


def main() -> None:
    """Run the node."""
    run(RobotModelNode)


if __name__ == '__main__':
    main()
