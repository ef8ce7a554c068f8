"""Whether what a person asked for has come true, by what the robot itself reports since.

A click is no evidence, nor is a service that says yes: STOP is done when the robot says that it is
stopped and its wheels are measured to stand.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.core import conversions
from agv_motion.dashboard.core.numbers import finite
from agv_motion.dashboard.core.summary import activity

if TYPE_CHECKING:
    from agv_motion.dashboard.core.robot_state import RobotState

NEAR = 0.3
"""[m] A pose that was set is reported again within this: fixes correct it at once."""
SAME = 0.01
"""[m] A goal is the one that was asked for."""


def is_done(
    robot: RobotState, action: str, arguments: dict[str, Any], since: float, now: float
) -> bool | None:
    """Return whether an act has come true.

    Args:
        robot: What is known of it.
        action: What was asked.
        arguments: With what.
        since: When it was asked [s], on the clock of the board.
        now: The same clock.

    Returns:
        None: nobody there tells, and the answer of the robot is all that can be had.

    """
    if action in {'stop', 'release'}:
        return _is_held(robot, since, hold=action == 'stop')
    if action in {'pause', 'resume'}:
        word = activity(robot, now)
        if not word or not _has_told(robot, since):
            return None if not word else False
        return (word == 'paused') == (action == 'pause')
    if action in {'lock', 'unlock'}:
        locked = _is_locked(robot, since)
        return False if locked is None else locked == (action == 'lock')
    if action in {'goal', 'pose'}:
        return _is_at(robot, action, arguments, since)
    return None


def _is_held(robot: RobotState, since: float, *, hold: bool) -> bool | None:
    driver = robot.latest.get('driver')
    if driver is not None:
        if driver.message is None:
            return False
        told = conversions.driver(driver.message)['stop'] is hold
    elif not hold:
        return None
    else:
        told = True  # no arbiter: the kinematics have said yes, and the wheels tell the rest
    return told and (not hold or (_is_measured(robot, since) and robot.stands()))


def _is_measured(robot: RobotState, since: float) -> bool:
    """Return whether the wheels have been measured since."""
    entries = [robot.latest.get(topic) for topic in ('turrets/state', 'wheels/state')]
    return any(entry is not None and entry.at > since for entry in entries)


def _has_told(robot: RobotState, since: float) -> bool:
    return any(
        node.at > since and node.told['values'].get('activity') for node in robot.nodes.values()
    )


def _is_locked(robot: RobotState, since: float) -> bool | None:
    driver = robot.latest.get('driver')
    if driver is None or driver.message is None or driver.at < since:
        return None
    return 'manual' in conversions.driver(driver.message)['lock']


def _is_at(robot: RobotState, topic: str, asked: dict[str, Any], since: float) -> bool | None:
    entry = robot.latest.get(topic)
    if entry is None or entry.message is None or entry.at < since:
        return False
    pose = entry.message.pose if topic == 'goal' else entry.message.pose.pose
    x, y = finite(pose.position.x), finite(pose.position.y)
    if x is None or y is None:
        return False
    return hypot(x - asked['x'], y - asked['y']) <= (SAME if topic == 'goal' else NEAR)
