"""What a tree drank today: litres with their interval, and hours at full flow."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.dashboard.core.numbers import finite
from agv_motion.probe.water import LONGEST_GAP

if TYPE_CHECKING:
    from typing import Any

    from agv_motion.dashboard.core.conversions import Value
    from agv_motion.dashboard.core.robot_state import RobotState

TODAY = 'granier/water_use_today'


def drank(robot: RobotState, time: float, hours: object) -> Value | None:
    """Return what a robot drank today; None where nobody told anything of it.

    Litres are told only by who knows the area of its sapwood, and only while they are news: those
    of a probe that has fallen silent may be of yesterday.

    Args:
        robot: Who drinks.
        time: Of the robots now [s since 1970].
        hours: At full flow; None where no sap flow was ever told.

    """
    found: Value | None = robot.converted(TODAY, _litres)
    if found is not None and abs(time - found['time']) > LONGEST_GAP:
        found = None
    if hours is None and TODAY not in robot.latest:
        return None
    return {'hours': hours, 'litres': None if found is None else found['litres']}


def _litres(message: Any) -> Value | None:
    """Return a geometry_msgs/Vector3Stamped of value and interval [l], and of when it is."""
    stamp, vector = message.header.stamp, message.vector
    numbers = [finite(n, 3) for n in (vector.x, vector.y, vector.z)]
    if None in numbers:
        return None
    litres = dict(zip(('value', 'low', 'high'), numbers, strict=True))
    return {'time': stamp.sec + 1e-9 * stamp.nanosec, 'litres': litres}
