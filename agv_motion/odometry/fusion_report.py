"""What a fusion tells: the fate of each fix, the pose, and how far to trust it."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from agv_motion.odometry.covariance import Covariance
    from agv_motion.planar import Pose


class FixVerdict(Enum):
    """What became of a fix."""

    ACCEPTED = 'accepted'
    REJECTED = 'too far from what is believed: rejected'
    SEARCHING = 'kept until enough fixes agree on where the robot is and looks'
    KIDNAPPED = 'agrees with those rejected before: the robot was carried away'
    WAITING = 'newer than the odometry: waits for it'
    LATE = 'too old: ignored'
    EARLY = 'stamp far ahead of the odometry: ignored, compare the clocks'
    DUPLICATE = 'the same fix again: ignored'


class FusionState(Enum):
    """How far the estimate is to be trusted."""

    WAITING = 'no odometry, or no fix yet'
    SEARCHING = 'position or heading not known yet: let the robot move'
    TRACKING = 'odometry and fixes agree'
    DOUBTFUL = 'the last fixes do not agree with the estimate'
    ODOMETRY_ONLY = 'no fix for a while: odometry alone'


class Estimate(NamedTuple):
    """Where the robot is."""

    stamp: float
    """[s] of the odometry it is based on"""
    pose: Pose
    """In `map`"""
    covariance: Covariance
    """Of the pose, in the axes of `map`"""
    map_to_odom: Pose
    """The transform of REP-105"""


class Health(NamedTuple):
    """Whether to believe the estimate, and why."""

    state: FusionState
    position_deviation: float
    """[m] the larger standard deviation of x and y; infinite when unknown"""
    heading_deviation: float
    """[rad]"""
    since_fix: float
    """[s] since the last fix that was accepted"""
    verdicts: dict[FixVerdict, int]
    """How many fixes each verdict was given to"""
