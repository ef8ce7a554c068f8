"""Nav2's goals as orders to a robot: what each asks, how it goes, and its numbers for errors.

Requests and feedback are those of nav2_msgs for Jazzy, of whatever class: nothing is imported.
"""

from __future__ import annotations

from math import copysign, isfinite
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.client.goal_runner import ControllerError, GoalError, GoalProgress
from agv_motion.errors import ConfigurationError
from agv_motion.planar import require_finite
from agv_motion.ros.messages import fill_pose, pose_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from agv_motion.client.robot import Robot

SECOND = 1_000_000_000
SLOWEST = 0.01
"""[m/s] A robot that is slower does not tell when it will be there."""
CONTROLLERS = '', 'route_follower', 'ghost_trajectory'
"""of follow_path: the first two take the places of a path, the last its headings, too"""


def _codes(unknown: int, timeout: int, frame: int, refused: int, stands: int) -> dict[Any, int]:
    """Return the numbers of an action for its errors."""
    return {
        GoalError.NONE: 0, GoalError.UNKNOWN: unknown, GoalError.TIMEOUT: timeout,
        GoalError.FRAME: frame, GoalError.REFUSED: refused, GoalError.NO_PROGRESS: stands,
        GoalError.CONTROLLER: unknown + 1,
    }  # fmt: skip


FOLLOWING = _codes(100, 107, 102, 103, 105)
"""UNKNOWN, CONTROLLER_TIMED_OUT, TF_ERROR, INVALID_PATH, FAILED_TO_MAKE_PROGRESS, and after the
first INVALID_CONTROLLER; a navigator hands those of its controller on."""
SPINNING = _codes(700, 701, 702, 700, 700)
"""UNKNOWN, TIMEOUT, TF_ERROR; there is none for bad input"""
DRIVING = _codes(720, 721, 722, 724, 720)
"""UNKNOWN, TIMEOUT, TF_ERROR, INVALID_INPUT"""


class Nav2Action(NamedTuple):
    """One action of Nav2."""

    name: str
    kind: str
    """of its class in nav2_msgs.action"""
    codes: Mapping[GoalError, int]
    frame: Callable[[Any], str]
    """returns the frame of a request"""
    order: Callable[[Robot, Any], None]
    fill: Callable[[Any, GoalProgress, str], None]
    """writes feedback, of a goal in a frame"""


def allowance_of(request: Any) -> float:
    """Return the time that a request leaves [s]; 0: any time."""
    given = getattr(request, 'time_allowance', None)
    return 0.0 if given is None else max(given.sec + given.nanosec / SECOND, 0.0)


def fill_duration(message: Any, seconds: float) -> None:
    """Write a time [s] into a builtin_interfaces/Duration."""
    message.sec, message.nanosec = divmod(round(seconds * SECOND), SECOND)


def _navigate(robot: Robot, request: Any) -> None:
    pose = pose_of(request.pose.pose)
    heading = pose.theta if robot.takes_headings() else None
    robot.go_to(pose.x, pose.y, heading, frame=request.pose.header.frame_id)


def _fill_navigation(feedback: Any, progress: GoalProgress, frame: str) -> None:
    if progress.pose is not None:
        feedback.current_pose.header.frame_id = frame
        fill_pose(feedback.current_pose.pose, progress.pose)
    fill_duration(feedback.navigation_time, progress.seconds)
    left = progress.distance_left
    feedback.distance_remaining = left if isfinite(left) else 0.0
    if isfinite(left) and progress.speed > SLOWEST:
        fill_duration(feedback.estimated_time_remaining, left / progress.speed)


def _follow(robot: Robot, request: Any) -> None:
    controller, frame = request.controller_id, request.path.header.frame_id
    if controller not in CONTROLLERS:
        msg = f"controller_id '{controller}': there are {', '.join(CONTROLLERS[1:])}"
        raise ControllerError(msg)
    for each in request.path.poses:
        if each.header.frame_id not in {'', frame}:
            msg = f"a pose in '{each.header.frame_id}' on a path in '{frame}': give all in one"
            raise ConfigurationError(msg)
    poses = [pose_of(each.pose) for each in request.path.poses]
    if not poses:
        msg = 'the path has no poses'
        raise ConfigurationError(msg)
    if controller == CONTROLLERS[2]:
        robot.follow_path(poses, frame=frame)
    else:
        robot.follow_route([pose[:2] for pose in poses], frame=frame)


def _fill_following(feedback: Any, progress: GoalProgress, _: str) -> None:
    left = progress.distance_left
    feedback.distance_to_goal = left if isfinite(left) else 0.0
    feedback.speed = progress.speed


def _spin(robot: Robot, request: Any) -> None:
    robot.spin(request.target_yaw)


def _fill_spin(feedback: Any, progress: GoalProgress, _: str) -> None:
    feedback.angular_distance_traveled = progress.turned


def _drive(robot: Robot, request: Any) -> None:
    target, speed = request.target, request.speed
    require_finite('target, speed', (target.x, target.y, target.z, speed))
    if target.y or target.z:
        msg = f'target = ({target.x:g}, {target.y:g}, {target.z:g}) m: give x only, straight on'
        raise ConfigurationError(msg)
    if not speed or copysign(1.0, target.x) != copysign(1.0, speed):
        msg = f'target.x = {target.x:g} m with speed = {speed:g} m/s: give both the same sign'
        raise ConfigurationError(msg)
    robot.drive_straight(target.x, abs(speed))


def _fill_driving(feedback: Any, progress: GoalProgress, _: str) -> None:
    feedback.distance_traveled = progress.distance


def _nowhere(_: Any) -> str:
    return ''


ACTIONS = (
    Nav2Action('navigate_to_pose', 'NavigateToPose', FOLLOWING,
               lambda request: str(request.pose.header.frame_id), _navigate, _fill_navigation),
    Nav2Action('follow_path', 'FollowPath', FOLLOWING,
               lambda request: str(request.path.header.frame_id), _follow, _fill_following),
    Nav2Action('spin', 'Spin', SPINNING, _nowhere, _spin, _fill_spin),
    Nav2Action('drive_on_heading', 'DriveOnHeading', DRIVING, _nowhere, _drive, _fill_driving),
)  # fmt: skip
