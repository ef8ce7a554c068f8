r"""What a fusion believes: where the frame `odom` lies in `map`, and how sure it is of that.

The robot is at map_to_odom * odometry. Odometry is a measurement, exact by definition in its own
frame, so only `map_to_odom` has to be estimated, and between fixes it stands still. Its error is a
small motion about the origin of `odom`,

.. math:: T_{true} = T \exp(\eta) O, \qquad \eta \sim N(0, P)

A noisy displacement of odometry adds to :math:`\eta` exactly what odometry itself adds to its
covariance about the origin: prediction is one sum, whatever was driven meanwhile, and a late fix
needs only the few fixes after it again, not the odometry. A fix is taken with the origin moved to
the robot, where its rows are those of the unit matrix, independent of any estimate. All this is
the left-invariant extended Kalman filter in other coordinates.

Source: A. Barrau, S. Bonnabel, "The invariant extended Kalman filter as a stable observer", IEEE
Trans. Autom. Control 62(4), 2017.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from agv_motion.odometry.covariance import Covariance, rotate, shift
from agv_motion.odometry.kalman import Vector, correct
from agv_motion.planar import Pose, Twist, compose, exponential, inverse, wrap

if TYPE_CHECKING:
    from agv_motion.odometry.fix import Fix
    from agv_motion.odometry.history import Waypoint


class Belief(NamedTuple):
    """Where `odom` lies in `map`, as of a waypoint."""

    map_to_odom: Pose
    covariance: Covariance
    """Of the error about the origin of `odom`"""
    waypoint: Waypoint


class Drift(NamedTuple):
    """What makes odometry and fixes part even at rest, as variances a second."""

    position: float
    """[m2/s]"""
    heading: float
    """[rad2/s]"""


class FixUpdate(NamedTuple):
    """A fix beside what was believed."""

    belief: Belief
    """With the fix taken in"""
    distance: float
    """[-] squared Mahalanobis distance of the fix from the belief: chi-square when all is well"""


def believe(pose: Pose, covariance: Covariance, waypoint: Waypoint) -> Belief:
    """Return the belief that the robot is at ``pose`` in `map`.

    Args:
        pose: Pose in `map`.
        covariance: Of it, in the axes of `map`.
        waypoint: Where odometry sees the robot now.

    """
    map_to_odom = compose(pose, inverse(waypoint.pose))
    at_robot = rotate(covariance, -map_to_odom.theta)
    return Belief(map_to_odom, shift(at_robot, -waypoint.pose.x, -waypoint.pose.y), waypoint)


def covariance_at(belief: Belief, waypoint: Waypoint, drift: Drift) -> Covariance:
    """Return the covariance about the robot, in the axes of `odom`, once it is at ``waypoint``."""
    grown = [
        believed + now - then
        for believed, now, then in zip(
            belief.covariance, waypoint.noise, belief.waypoint.noise, strict=True
        )
    ]
    xx, xy, xt, yy, yt, tt = shift(Covariance(*grown), waypoint.pose.x, waypoint.pose.y)
    elapsed = waypoint.stamp - belief.waypoint.stamp
    moved, turned = drift.position * elapsed, drift.heading * elapsed
    return Covariance(xx + moved, xy, xt, yy + moved, yt, tt + turned)


def take(belief: Belief, waypoint: Waypoint, fix: Fix, drift: Drift) -> FixUpdate:
    """Return the belief at ``waypoint`` with a fix measured there, and how surprising that is."""
    map_to_odom, (_, position, _) = belief.map_to_odom, waypoint
    seen = compose(map_to_odom, position)
    turn = map_to_odom.theta
    missed = compose(Pose(0.0, 0.0, -turn), Pose(fix.x - seen.x, fix.y - seen.y, 0.0))
    away = 0.0 if fix.heading is None else wrap(fix.heading - seen.theta)
    correction, covariance, distance = correct(
        covariance_at(belief, waypoint, drift),
        (missed.x, missed.y, away),
        rotate(fix.covariance, -turn),
        3 if fix.heading is not None else 2,
    )
    return FixUpdate(
        Belief(
            compose(map_to_odom, _about(position, correction)),
            shift(covariance, -position.x, -position.y),
            waypoint,
        ),
        distance,
    )


def _about(centre: Pose, motion: Vector) -> Pose:
    """Return the pose that ``motion`` of a frame through ``centre`` takes the origin to."""
    moved = compose(Pose(centre.x, centre.y, 0.0), exponential(Twist(*motion)))
    return compose(moved, Pose(-centre.x, -centre.y, 0.0))
