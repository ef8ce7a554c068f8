"""Fusion of odometry with position fixes: where the robot is in `map`, and whether to believe it.

The estimate is a `belief`. Around it stand a gate that keeps outliers out and a buffer in which
late fixes take their place in time (`fix_buffer`), an `alignment` that finds the heading at the
start, and the judgement that the robot was carried away: when fixes in a row agree with one
another but no more with the belief.
"""

from __future__ import annotations

from math import ceil, inf, sqrt
from typing import TYPE_CHECKING

from agv_motion.errors import SignalError
from agv_motion.odometry.alignment import FixAtPose, align, thin
from agv_motion.odometry.belief import Belief, Drift, believe, covariance_at
from agv_motion.odometry.continuity import Succession
from agv_motion.odometry.covariance import Covariance, rotate
from agv_motion.odometry.fix_buffer import FixBuffer
from agv_motion.odometry.fusion_parameters import FusionParameters
from agv_motion.odometry.fusion_report import Estimate, FixVerdict, FusionState, Health
from agv_motion.odometry.gates import (
    MAX_COORDINATE,
    MAX_DEVIATION,
    MAX_TURN_DEVIATION,
    require_measurement,
    require_within,
)
from agv_motion.odometry.history import OdometryHistory, Waypoint
from agv_motion.odometry.leap import Leap
from agv_motion.odometry.odometry_intake import OdometryIntake, Passage
from agv_motion.planar import Pose, compose, require_finite

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.odometry.fix import Fix

AGREEING = 0.6
"""[-] Share of the fixes that must agree on where the robot is."""
MOST_SIGHTINGS = 24
"""Fixes kept while searching, spread over the way; more would only take time."""
MOST_WAITING = 50
"""Fixes that may wait for odometry to come up to them."""
DOUBT = 3
"""Fixes rejected in a row that make the estimate doubtful."""


class PoseFusion:
    """Takes odometry and fixes in any order; tells pose and health at any time."""

    def __init__(self, parameters: FusionParameters | None = None) -> None:
        """Start knowing nothing."""
        self._given = parameters or FusionParameters()
        self._drift = Drift(self._given.position_drift**2, self._given.heading_drift**2)
        self._tag = Pose(self._given.tag_x, self._given.tag_y, 0.0)
        self._intake = OdometryIntake(self._given)
        self._history = OdometryHistory(self._given.horizon)
        self._waiting: list[Fix] = []
        self._verdicts = dict.fromkeys(FixVerdict, 0)
        self.restart()

    def restart(self) -> None:
        """Forget where the robot is and search for it anew."""
        self._buffer: FixBuffer | None = None
        self._guess: Belief | None = None
        self._sightings: list[FixAtPose] = []
        self._accepted_at: float | None = None

    def set_pose(self, pose: Pose, covariance: Covariance) -> None:
        """Believe that the robot is at ``pose``, as somebody says.

        Args:
            pose: In `map`, now.
            covariance: Of it, in the axes of `map`.

        Raises:
            SignalError: A number is not finite, the covariance is not positive definite, or there
                is no odometry yet to go on from.

        """
        require_finite('pose', pose)
        require_within('pose', pose, MAX_COORDINATE, 'm (rad)', 'give it in the map')
        require_measurement('pose', covariance, heading=True)
        if not self._history:
            msg = 'the pose can be set once there is odometry: start that first'
            raise SignalError(msg)
        self.restart()
        self._track(believe(pose, covariance, self._history.newest))

    def add_odometry(self, stamp: float, pose: Pose, origin_covariance: Covariance) -> Succession:
        """Take in where odometry sees the robot; what does not follow is ignored: `continuity`.

        Args:
            stamp: Time [s].
            pose: In `odom`.
            origin_covariance: Of the error about the origin of `odom` since odometry began, see
                `dead_reckoning`.

        Raises:
            SignalError: A number is not finite, or beyond its gate.

        """
        passage = self._intake.take(stamp, pose, origin_covariance)
        self.follow(passage)
        return passage.step

    def follow(self, passage: Passage) -> None:
        """Take in a message of odometry that an `OdometryIntake` made ready."""
        step, now, *_ = passage
        if not step.used:
            return
        if step in {Succession.LEAP, Succession.RESET} and self._history:
            self._leap(passage)
        self._history.append(now)
        if self._waiting and self._waiting[0].stamp <= now.stamp:
            ready = [fix for fix in self._waiting if fix.stamp <= now.stamp]
            del self._waiting[: len(ready)]
            for fix in ready:
                self._judge(fix)

    def add_fix(self, fix: Fix) -> FixVerdict:
        """Take in a position fix, in time, late or out of order; return what became of it."""
        ahead = fix.stamp - self._history.newest.stamp if self._history else 0.5
        if 0.0 < ahead <= max(self._given.horizon, 1.0):
            if fix not in self._waiting:
                self._waiting = sorted([*self._waiting, fix], key=lambda waiting: waiting.stamp)
            del self._waiting[:-MOST_WAITING]
            return self._count(FixVerdict.WAITING)
        return self._judge(fix)

    @property
    def newest_stamp(self) -> float:
        """Time of the newest odometry [s]; minus infinity before the first."""
        return self._history.newest.stamp if self._history else -inf

    def estimate(self) -> Estimate | None:
        """Return where the robot is as of the newest odometry; None while nothing is known."""
        belief = self._belief()
        if belief is None:
            return None
        now = self._history.newest
        covariance = covariance_at(belief, now, self._drift)
        return Estimate(
            now.stamp,
            compose(belief.map_to_odom, now.pose),
            rotate(covariance, belief.map_to_odom.theta),
            belief.map_to_odom,
        )

    def health(self) -> Health:
        """Return how far the estimate is to be trusted."""
        estimate = self.estimate()
        if estimate is None:
            state = FusionState.SEARCHING if self._sightings else FusionState.WAITING
            return Health(state, inf, inf, inf, dict(self._verdicts))
        since = inf if self._accepted_at is None else estimate.stamp - self._accepted_at
        state = FusionState.TRACKING
        if self._buffer is None:
            state = FusionState.SEARCHING
        elif len(self._buffer.rejected()) >= DOUBT:
            state = FusionState.DOUBTFUL
        elif since > self._given.fix_timeout:
            state = FusionState.ODOMETRY_ONLY
        xx, _, _, yy, _, tt = estimate.covariance
        return Health(state, sqrt(max(xx, yy)), sqrt(tt), since, dict(self._verdicts))

    def _belief(self) -> Belief | None:
        return self._buffer.belief if self._buffer is not None else self._guess

    def _judge(self, fix: Fix) -> FixVerdict:
        """Decide about a fix that is not newer than the odometry."""
        if fix.stamp > self._history.newest.stamp:
            return self._count(FixVerdict.EARLY)
        horizon = max(self._history.newest.stamp - self._given.horizon, self._history.oldest.stamp)
        if fix.stamp < horizon or (self._buffer is not None and fix.stamp < self._buffer.start):
            return self._count(FixVerdict.LATE)
        sighting = FixAtPose(fix, self._tag_at(self._history.at(fix.stamp)))
        if self._is_lost(sighting.waypoint):
            self.restart()
        if self._buffer is None:
            return self._count(self._search(sighting))
        if sighting in self._buffer:
            return self._count(FixVerdict.DUPLICATE)
        verdict = FixVerdict.REJECTED
        if self._buffer.take(sighting):
            verdict = FixVerdict.ACCEPTED
            self._accepted_at = max(fix.stamp, self._accepted_at or fix.stamp)
        elif self._is_kidnapped(self._buffer):
            verdict = FixVerdict.KIDNAPPED
        if self._buffer is not None:
            self._buffer.forget(horizon)
        return self._count(verdict)

    def _tag_at(self, waypoint: Waypoint) -> Waypoint:
        """Return where the tag was: errors about the origin of `odom` are the same for it.

        So the way from the robot's centre to the tag enters by moving the origin there, as `belief`
        does for any place: exact, with the turn that the fix thereby tells of.
        """
        return waypoint._replace(pose=compose(waypoint.pose, self._tag))

    def _is_lost(self, waypoint: Waypoint) -> bool:
        """Return whether the robot may be anywhere: only a search can find it again."""
        if self._buffer is None:
            return False
        (x, y, _), noise, known = waypoint.pose, waypoint.noise, self._buffer.belief.covariance
        # more than there is anywhere within the way to the origin: the usual case costs little
        spread = noise.xx + noise.yy + known.xx + known.yy
        most = spread + (1.0 + x * x + y * y) * (noise.tt + known.tt)
        if most < 0.1 * MAX_DEVIATION:
            return False
        xx, _, _, yy, _, tt = covariance_at(self._buffer.belief, waypoint, self._drift)
        return max(xx, yy) > MAX_DEVIATION**2 or tt > MAX_TURN_DEVIATION**2

    def _search(self, sighting: FixAtPose) -> FixVerdict:
        """Keep the fix, and see whether enough of them agree on position and heading."""
        if any(known.fix == sighting.fix for known in self._sightings):
            return FixVerdict.DUPLICATE
        self._sightings.append(sighting)
        self._sightings.sort(key=lambda known: known.fix.stamp)
        while self._sightings[0].fix.stamp < sighting.fix.stamp - self._given.search_time:
            del self._sightings[0]
        if len(self._sightings) > MOST_SIGHTINGS:
            thin(self._sightings)
        if len(self._sightings) < self._given.alignment_fixes:
            return FixVerdict.SEARCHING
        heading = self._guess.map_to_odom.theta if self._guess else 0.0
        self._settle(self._align(self._sightings, heading))
        return FixVerdict.SEARCHING if self._buffer is None else FixVerdict.ACCEPTED

    def _is_kidnapped(self, buffer: FixBuffer) -> bool:
        """Begin the search anew if the rejected fixes agree on another place; return whether."""
        rejected = buffer.rejected()
        if len(rejected) < self._given.kidnap_fixes:
            return False
        if rejected[-1].fix.stamp - rejected[0].fix.stamp < self._given.kidnap_time:
            return False
        belief = self._align(rejected, buffer.belief.map_to_odom.theta)
        if belief is None:
            return False
        self._buffer, self._sightings = None, list(rejected)
        self._settle(belief)
        return True

    def _align(self, sightings: Sequence[FixAtPose], heading: float) -> Belief | None:
        needed = max(self._given.alignment_fixes, ceil(AGREEING * len(sightings)))
        return align(sightings, heading, needed)

    def _settle(self, belief: Belief | None) -> None:
        """Go on with what an alignment found: track once the heading is known."""
        if belief is None:
            return
        self._guess, self._accepted_at = belief, belief.waypoint.stamp
        if covariance_at(belief, belief.waypoint, self._drift).tt <= self._given.heading_known**2:
            self._track(belief)

    def _track(self, belief: Belief) -> None:
        given = self._given
        self._buffer = FixBuffer(
            belief, self._drift, given.gate, given.kidnap_fixes, given.kidnap_time
        )
        self._guess, self._sightings = None, []

    def _leap(self, passage: Passage) -> None:
        """Keep the robot where it is in `map`, less sure, when the clock or odometry leaps."""
        leap = Leap(self._history.last_two(), passage)
        belief = self._belief()
        self._history.clear()
        self._sightings = []
        if leap.of_clock:  # fixes of another time would never come
            self._waiting.clear()
        if leap.of_all:
            self.restart()
        elif belief is not None:
            kept = leap.keep(belief, self._drift)
            self._accepted_at = None if self._accepted_at is None else kept.waypoint.stamp
            if self._buffer is not None:
                self._track(kept)
            else:
                self._guess = kept

    def _count(self, verdict: FixVerdict) -> FixVerdict:
        self._verdicts[verdict] += 1
        return verdict
