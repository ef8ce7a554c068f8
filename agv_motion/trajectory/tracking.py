r"""The error of a robot behind its Ghost, and what a law of control makes of it.

The Ghost seen from the robot is at :math:`e = (x_e, y_e, \theta_e)`. When the robot drives with
:math:`(v, \omega)` and the Ghost with :math:`(v_r, \omega_r)`,

.. math:: \dot x_e = \omega y_e - v + v_r \cos\theta_e, \quad
    \dot y_e = -\omega x_e + v_r \sin\theta_e, \quad \dot\theta_e = \omega_r - \omega   \tag{1}

Each law here comes with a Lyapunov function: never negative, zero only on the trajectory, and under
the law it never grows, whatever the Ghost does.

Source: Y. Kanayama, Y. Kimura, F. Miyazaki, T. Noguchi, "A stable tracking control method for an
autonomous mobile robot", Proc. IEEE Int. Conf. Robotics and Automation, 1990, equations 5 to 7.
"""

from __future__ import annotations

from math import cos, sin
from typing import TYPE_CHECKING, NamedTuple, Protocol

from agv_motion.planar import Pose, Twist, wrap

if TYPE_CHECKING:
    from agv_motion.trajectory.motion import Speeds


class TrackingError(NamedTuple):
    """The Ghost seen from the robot."""

    along: float
    """[m] ahead"""
    across: float
    """[m] to the left"""
    heading: float
    """[rad] in [-pi, pi)"""


class TrackingLaw(Protocol):
    """What to drive, from the error and from what the Ghost drives."""

    goes_sideways: bool
    """Whether it closes an error across at rest"""

    def twist(self, error: TrackingError, reference: Speeds) -> Twist:
        """Return the twist of the robot, in its own frame."""

    def lyapunov(self, error: TrackingError) -> float:
        """Return how far from the trajectory that is; it never grows."""


def tracking_error(reference: Pose, actual: Pose) -> TrackingError:
    """Return ``reference`` seen from ``actual``; both in one frame."""
    dx, dy = reference.x - actual.x, reference.y - actual.y
    c, s = cos(actual.theta), sin(actual.theta)
    return TrackingError(c * dx + s * dy, c * dy - s * dx, wrap(reference.theta - actual.theta))
