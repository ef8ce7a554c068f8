"""Between the values of the core and standard messages; refuses what the core could not use."""

from __future__ import annotations

from math import atan2, cos, isfinite, sin
from typing import TYPE_CHECKING, Any, NamedTuple

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import JointState

from agv_motion.errors import SignalError
from agv_motion.planar import FARTHEST, Pose, Twist, require_finite, require_twist

if TYPE_CHECKING:
    from collections.abc import Sequence


def type_name(kind: type[Any]) -> str:
    """Return the name of a message class, such as ``geometry_msgs/msg/Twist``."""
    return f'{kind.__module__.partition(".")[0]}/msg/{kind.__name__}'


def seconds_of(stamp: Any) -> float:
    """Return a builtin_interfaces/Time in seconds."""
    return float(stamp.sec) + float(stamp.nanosec) * 1e-9


def stamp_of(nanoseconds: int) -> Time:
    """Return nanoseconds as a builtin_interfaces/Time."""
    seconds, rest = divmod(nanoseconds, 1_000_000_000)
    return Time(sec=seconds, nanosec=rest)


def require_frame(frame: str, *expected: str) -> None:
    """Raise unless a message's frame is as expected; one that is not given is.

    Raises:
        SignalError: It is another.

    """
    if frame and frame.removeprefix('/') not in expected:
        names = ' or '.join(f"'{name}'" for name in expected)
        msg = f"frame '{frame}': expected {names}; transform it first, or set the frame parameter"
        raise SignalError(msg)


def twist_of(message: Any) -> Twist:
    """Return the planar part of a geometry_msgs/Twist.

    Raises:
        SignalError: One of its three planar numbers is not finite, or beyond any robot.

    """
    twist = Twist(message.linear.x, message.linear.y, message.angular.z)
    require_twist(twist)
    return twist


def fill_twist(message: Any, twist: Twist) -> None:
    """Write ``twist`` into a geometry_msgs/Twist; whole numbers too, as `fill_pose`."""
    message.linear.x, message.linear.y, message.angular.z = map(float, twist)


def pose_of(message: Any) -> Pose:
    """Return the planar part of a geometry_msgs/Pose; heading from the quaternion.

    Raises:
        SignalError: A number is not finite, the place is no place of a map, or the quaternion is
            not of unit length.

    """
    p, q = message.position, message.orientation
    require_finite('pose', (p.x, p.y, q.x, q.y, q.z, q.w))
    if not (abs(p.x) <= FARTHEST and abs(p.y) <= FARTHEST):
        msg = f'pose at ({p.x:g}, {p.y:g}): must be within {FARTHEST:g} m of the origin; metres?'
        raise SignalError(msg)
    norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w
    if abs(norm - 1.0) > 0.01:
        msg = (
            f'orientation (x={q.x}, y={q.y}, z={q.z}, w={q.w}) has length {norm**0.5:.3g}: '
            'a quaternion must have length 1; for no rotation give w = 1'
        )
        raise SignalError(msg)
    heading = atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
    return Pose(p.x, p.y, heading)


def fill_pose(message: Any, pose: Pose) -> None:
    """Write ``pose`` into a geometry_msgs/Pose; whole numbers too, which a message would garble."""
    message.position.x, message.position.y = float(pose.x), float(pose.y)
    fill_rotation(message.orientation, pose.theta)


def fill_rotation(quaternion: Any, heading: float) -> None:
    """Write a rotation by ``heading`` [rad] about z into a geometry_msgs/Quaternion."""
    quaternion.z, quaternion.w = sin(heading / 2.0), cos(heading / 2.0)


def points_of(path: Any) -> list[tuple[float, float]]:
    """Return the places of a nav_msgs/Path [m]; what is not finite is left to the core."""
    return [(p.pose.position.x, p.pose.position.y) for p in path.poses]


def fill_path(path: Any, poses: Sequence[Pose]) -> None:
    """Write ``poses`` into a nav_msgs/Path, all with its own header."""
    path.poses = [PoseStamped(header=path.header) for _ in poses]
    for stamped, pose in zip(path.poses, poses, strict=True):
        fill_pose(stamped.pose, pose)


class TurretState(NamedTuple):
    """What the turrets tell of themselves."""

    angles: list[float]
    """(n,) steering angles [rad]"""
    rates: list[float]
    """(n,) rates of the wheels [rad/s]; empty where they are of no use"""
    turned: list[float]
    """(n,) angles of the wheels [rad]; empty where nobody counts them"""
    wrong: str
    """Why rates are of no use; empty when they are"""


NEEDED = {'positions': 'turret angles', 'velocities': 'wheel rates'}
"""What is needed of each field of a JointState of turrets."""


def _finite(
    field: str, values: Sequence[float], names: Sequence[str], places: Sequence[int]
) -> list[float]:
    """Return the values of some joints, or raise why not."""
    if len(values) != len(names):
        msg = f'{len(values)} {field} for {len(names)} joints: give one each'
        raise SignalError(msg)
    picked = [values[place] for place in places]
    if not isfinite(sum(picked)):
        require_finite(NEEDED[field], tuple(picked))
    return picked


class TurretJoints:
    """Turrets as joints: ``turret_i_steering`` by position, ``turret_i_wheel`` by velocity."""

    def __init__(self, count: int) -> None:
        """Name the joints of ``count`` turrets."""
        self._steering = [f'turret_{i}_steering' for i in range(count)]
        self._wheel = [f'turret_{i}_wheel' for i in range(count)]
        self._zeros = [0.0] * count
        self._names: list[str] = []
        self._places: tuple[list[int], list[int]] = [], []

    def message(self) -> JointState:
        """Return a message with the names set, to be filled again and again."""
        return JointState(name=self._steering + self._wheel)

    def standstill(self) -> JointState:
        """Return a command to the wheels alone, for turrets whose angles are not known."""
        return JointState(name=self._wheel, velocity=self._zeros)

    def is_standstill(self, message: JointState) -> bool:
        """Return whether ``message`` is a :meth:`standstill`, which leaves the turrets alone."""
        return list(message.name) == self._wheel and not any(message.velocity)

    def fill(
        self, message: JointState, angles: Sequence[float], rates: Sequence[float],
        turned: Sequence[float] = (),
    ) -> None:  # fmt: skip
        """Write steering angles [rad] and wheel rates [rad/s]; what a joint lacks is 0.

        A state tells by what angle each wheel has ``turned`` [rad], too.
        """
        message.position = [*angles, *(turned or self._zeros)]
        message.velocity = [*self._zeros, *rates]

    def read_state(self, message: JointState) -> TurretState:
        """Return what the turrets tell, whatever the order of the joints.

        Only what is needed is looked at: the positions of the steering joints, and the velocities
        of the wheels or, where these are of no use, their positions.

        Raises:
            SignalError: A joint is missing, an array does not fit the names, or a value that is
                needed is not finite.

        """
        steering, wheel = self.places(message.name)
        angles = _finite('positions', message.position, message.name, steering)
        turned = [message.position[i] for i in wheel]
        if not (any(turned) and isfinite(sum(turned))):  # 0: nobody counts the turns
            turned = []
        try:
            rates = _finite('velocities', message.velocity, message.name, wheel)
        except SignalError as error:
            if not turned:
                raise
            return TurretState(angles, [], turned, str(error))
        return TurretState(angles, rates, turned, '')

    def read(self, message: JointState) -> tuple[list[float], list[float]]:
        """Return steering angles [rad] and wheel rates [rad/s], whatever the order of the joints.

        Raises:
            SignalError: A joint is missing, an array does not fit the names, or a value that is
                needed is not finite.

        """
        steering, wheel = self.places(message.name)
        angles = _finite('positions', message.position, message.name, steering)
        return angles, _finite('velocities', message.velocity, message.name, wheel)

    def places(self, names: list[str]) -> tuple[list[int], list[int]]:
        """Return where among ``names`` the steering angles are, and where the wheels.

        Raises:
            SignalError: A joint is missing.

        """
        if names != self._names:
            index = {name: i for i, name in enumerate(names)}
            missing = [name for name in self._steering + self._wheel if name not in index]
            if missing:
                msg = (
                    f'joint {missing[0]} is missing among {names}: '
                    f'expected {len(self._steering)} turrets, each with _steering and _wheel'
                )
                raise SignalError(msg)
            self._names = list(names)
            self._places = (
                [index[name] for name in self._steering],
                [index[name] for name in self._wheel],
            )
        return self._places
