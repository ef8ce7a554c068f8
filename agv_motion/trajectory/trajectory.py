"""A trajectory: motions one after another, as a function of time."""

from __future__ import annotations

from bisect import bisect_right
from itertools import accumulate
from typing import TYPE_CHECKING

from agv_motion.trajectory.motion import STILL, Motion, Speeds

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.planar import Pose
    from agv_motion.trajectory.limits import BendLimit
    from agv_motion.trajectory.request import Request


class Trajectory:
    """Motions one after another, each from rest but the first; nothing in it changes."""

    def __init__(
        self,
        ends: tuple[Pose, Pose],
        motions: Sequence[Motion] = (),
        request: Request | None = None,
        limits: Sequence[BendLimit] = (),
    ) -> None:
        """Chain ``motions``; without any the robot stays where it is.

        Args:
            ends: Where it begins, and where it rests at last, to the last digit.
            motions: In their order.
            request: What was asked for.
            limits: What its curves have to keep.

        """
        self.start, self.end = ends
        self.motions = tuple(motions)
        self.request = request
        self.limits = tuple(limits)
        self._starts = list(accumulate((m.duration for m in self.motions), initial=0.0))
        self.duration = self._starts.pop()

    def pose(self, time: float) -> Pose:
        """Return the pose at ``time`` [s]; before the start and after the end, those."""
        if time >= self.duration or not self.motions:
            return self.end
        if len(self.motions) == 1:
            return self.motions[0].pose(time)
        motion, begin = self._at(time)
        return motion.pose(time - begin)

    def speeds(self, time: float) -> Speeds:
        """Return linear and angular speed at ``time`` [s]; zero when it has ended."""
        if time >= self.duration or not self.motions:
            return STILL
        if len(self.motions) == 1:
            return self.motions[0].speeds(time)
        motion, begin = self._at(time)
        return motion.speeds(time - begin)

    def rotating(self, time: float) -> bool:
        """Return whether it turns on the spot at ``time`` [s]."""
        return bool(self.motions) and self._at(time)[0].rotating

    def stopped(self, time: float) -> Trajectory:
        """Return the same trajectory until ``time`` [s], then braked to rest on its way."""
        if time >= self.duration:
            return self
        number = max(bisect_right(self._starts, time) - 1, 0)
        last = self.motions[number].stopped(time - self._starts[number])
        return Trajectory(
            (self.start, last.end), (*self.motions[:number], last), self.request, self.limits
        )

    def after(self, motion: Motion) -> Trajectory:
        """Return this trajectory with ``motion`` before it."""
        if motion.duration == 0.0:
            return self
        ends = motion.pose(0.0), self.end
        return Trajectory(ends, (motion, *self.motions), self.request, self.limits)

    def polyline(self, step: float, most: int | None = None) -> list[Pose]:
        """Return the poses at every ``step`` [s] and at the end, to draw it.

        Args:
            step: Between two poses [s].
            most: Number of poses, about, above which the steps are longer instead.

        """
        if most is not None:
            step = max(step, self.duration / most)
        count = int(self.duration / step)
        return [*(self.pose(k * step) for k in range(count + 1)), self.end]

    def _at(self, time: float) -> tuple[Motion, float]:
        number = max(bisect_right(self._starts, time) - 1, 0)
        return self.motions[number], self._starts[number]
