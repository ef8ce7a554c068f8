"""The transforms of one robot, from what it says of itself: odometry, pose and angles of joints.

    map ──> odom ──> base_link ──> turret_i ──> wheel_i

`odom` to the base is what odometry says. `map` to `odom` is what a pose in the map leaves of it:
the pose, and the odometry of the same instant taken back from it. It changes little, so it holds
until the next pose. The stamps of a transform only grow: what comes late, or twice, adds nothing.
"""

from __future__ import annotations

from collections import deque
from math import inf
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.model.transform import Transform, planar
from agv_motion.planar import Pose, compose, exponential, inverse, logarithm

if TYPE_CHECKING:
    from collections.abc import Mapping

    from agv_motion.model.robot_model import RobotModel

SECOND = 1_000_000_000
REMEMBERED = 500
"""Places in `odom` that are kept, to compare with a pose that comes late"""
RESET = SECOND
"""[ns] by which stamps go back where a clock began anew, rather than a message came late"""


class _Place(NamedTuple):
    stamp: int
    pose: Pose


class RobotTransforms:
    """Takes what a robot says, and returns the transforms that follow from it."""

    def __init__(self, model: RobotModel | None, prefix: str, hold: float = inf) -> None:
        """Know nothing yet of where the robot is.

        Args:
            model: Its links and joints; None: nobody has told.
            prefix: Before the names of its links.
            hold: How long the place of `odom` in the map counts after a pose [s]. Who steers by it
                must notice that the pose is lost. Infinite for a recording, which is looked at:
                then what was known first, of the map and of joints, counts for the odometry before
                it, too, and what was known last for all that comes behind.

        """
        self.model, self.prefix = model, prefix
        self._hold = hold
        self._places: deque[_Place] = deque(maxlen=REMEMBERED)
        self._first: int | None = None
        """stamp of the first odometry [ns]"""
        self._odom = ''
        self._told: dict[str, int] = {}
        """stamp of the last transform of each frame [ns]"""
        self._positions: Mapping[str, float] = {}
        """of joints, as they were told last"""
        self._waiting: tuple[str, _Place] | None = None
        """a pose that is newer than all odometry"""
        self._map: Transform | None = None
        """place of `odom` in the map, as of when it was known last"""

    def fixed(self, stamp: int) -> list[Transform]:
        """Return the transforms that hold for good, for ``/tf_static``."""
        return [] if self.model is None else self.model.fixed(stamp, self.prefix)

    def take_odometry(self, stamp: int, frame: str, child: str, pose: Pose) -> list[Transform]:
        """Return what follows from where the wheels have carried the robot.

        Args:
            stamp: Of the odometry [ns].
            frame: In which it is told, such as ``oak/odom``.
            child: Frame of the robot.
            pose: Of the robot.

        """
        if not frame or not child or frame == child:
            return []
        if self._places and stamp < self._places[-1].stamp - RESET:
            self._begin_anew()
        if self._places and stamp <= self._places[-1].stamp:
            return []
        before = self._places[-1].stamp if self._places else None
        self._odom = frame
        self._first = stamp if self._first is None else self._first
        self._places.append(_Place(stamp, pose))
        found = [planar(stamp, frame, child, pose)]
        if self._waiting is not None and self._waiting[1].stamp <= stamp:
            map_frame, place = self._waiting
            self._waiting = None
            found += self._locate(map_frame, place)
        if before is not None:  # a pose of this very instant may be on its way
            found += self._hold_map(before)
        return found

    def take_pose(self, stamp: int, frame: str, pose: Pose) -> list[Transform]:
        """Return what follows from where the robot is in the map.

        Args:
            stamp: Of the pose [ns].
            frame: Of the map.
            pose: Of the robot.

        """
        if not frame:
            return []
        place = _Place(stamp, pose)
        if not self._places or stamp > self._places[-1].stamp:
            self._waiting = frame, place
            return []
        return self._locate(frame, place)

    def take_joints(self, stamp: int, positions: Mapping[str, float]) -> list[Transform]:
        """Return what follows from the positions of joints [rad or m], by name."""
        if self.model is None:
            return []
        found: list[Transform] = []
        if not self._positions and self._hold == inf and self._first is not None:
            found += self.model.moved(min(self._first, stamp), self.prefix, positions)
        self._positions = positions
        found += self.model.moved(stamp, self.prefix, positions)
        return [transform for transform in found if self._is_news(transform)]

    def last(self) -> list[Transform]:
        """Return what there is to tell at the end, so that all reach as far as odometry."""
        if not self._places:
            return []
        stamp = self._places[-1].stamp
        held = [] if self.model is None else self.model.moved(stamp, self.prefix, self._positions)
        return [*self._hold_map(stamp), *(one for one in held if self._is_news(one))]

    def _locate(self, frame: str, place: _Place) -> list[Transform]:
        """Return the place of `odom` in the map, from that of the robot in both."""
        in_odom = self._odometry_at(place.stamp)
        if in_odom is None or frame == self._odom:
            return []
        known = self._map
        if known is not None and place.stamp < known.stamp:
            return []
        origin = compose(place.pose, inverse(in_odom))
        self._map = planar(place.stamp, frame, self._odom, origin)
        found = [self._map]
        if known is None and self._hold == inf and self._first is not None:
            found.insert(0, self._map._replace(stamp=self._first))
        return [transform for transform in found if self._is_news(transform)]

    def _hold_map(self, stamp: int) -> list[Transform]:
        """Return the place of `odom` in the map as it was known last, as long as it counts."""
        known = self._map
        if known is None or stamp - known.stamp > self._hold * SECOND:
            return []
        held = Transform(stamp, known.parent, self._odom, known.translation, known.rotation)
        return [held] if self._is_news(held) else []

    def _odometry_at(self, stamp: int) -> Pose | None:
        """Return where the robot was in `odom`, between two places on the arc that joins them."""
        after = None
        for place in reversed(self._places):
            if place.stamp == stamp:
                return place.pose
            if place.stamp < stamp:
                if after is None:
                    return None
                share = (stamp - place.stamp) / (after.stamp - place.stamp)
                step = logarithm(compose(inverse(place.pose), after.pose))
                return compose(place.pose, exponential(step, share))
            after = place
        return None

    def _is_news(self, transform: Transform) -> bool:
        """Return whether a frame's stamp has grown, and note it."""
        last = self._told.get(transform.child)
        if last is not None and last - RESET <= transform.stamp <= last:
            return False
        self._told[transform.child] = transform.stamp
        return True

    def _begin_anew(self) -> None:
        """Forget what was said by a clock that has gone back since."""
        self._places.clear()
        self._told.clear()
        self._first = self._waiting = self._map = None
