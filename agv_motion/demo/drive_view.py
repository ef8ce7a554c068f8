"""A robot without a zone as it drives, in the terminal: where it is, how fast, and what it does."""

from __future__ import annotations

from datetime import datetime, timezone
from math import pi
from typing import TYPE_CHECKING

from agv_motion.demo.readout import NOT_YET, lines, number, pace, pose_text
from agv_motion.ros.messages import pose_of

if TYPE_CHECKING:
    from rich.console import RenderableType

    from agv_motion.demo.map_view import Room
    from agv_motion.demo.recorder import DemoRecorder

WIDEST = 100


class DriveView:
    """Draws what the recorder has heard."""

    def __init__(self, recorder: DemoRecorder, poses: dict[str, str], state: str = '') -> None:
        """Show what the recorder hears of topics.

        Args:
            recorder: What has been heard.
            poses: Topics of odometry or poses, by the word that stands before them.
            state: Topic of a text, what the robot does; empty: there is none.

        """
        self._recorder, self._poses, self._state = recorder, poses, state

    def draw(self, now: float, factor: float, room: Room) -> RenderableType:
        """Return the picture at simulated ``now`` [s], passing ``factor`` times real time."""
        latest = self._recorder.latest
        moment = datetime.fromtimestamp(now, timezone.utc)
        rows = [('time', f'{moment:%H:%M:%S} UTC, {pace(factor)}')]
        for name, topic in self._poses.items():
            told = latest(topic)
            rows.append((name, NOT_YET if told is None else pose_text(pose_of(told.pose.pose))))
        twist = latest('cmd_vel')
        moves = NOT_YET
        if twist is not None:
            forward, left = twist.twist.linear.x, twist.twist.linear.y
            turn = number(twist.twist.angular.z * 180.0 / pi, 5, 1, sign=True)
            moves = (
                f'{number(forward, 6, 3, sign=True)} m/s forward '
                f'{number(left, 6, 3, sign=True)} m/s left {turn}°/s'
            )
        rows.append(('twist', moves))
        if self._state:
            state = latest(self._state)
            rows.append(('state', NOT_YET if state is None else state.data))
        return lines(rows, min(room.columns, WIDEST))
