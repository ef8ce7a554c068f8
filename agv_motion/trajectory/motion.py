"""What a trajectory is made of: motions, which go along curves or turn on the spot."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from agv_motion.planar import Pose
    from agv_motion.trajectory.bezier import Column


class Speeds(NamedTuple):
    """What a differential drive does."""

    linear: float
    """[m/s] forward"""
    angular: float
    """[rad/s] counter-clockwise"""


STILL = Speeds(0.0, 0.0)


class Curve(Protocol):
    """Points of the plane, as complex numbers, over a parameter."""

    def point(self, u: float, /) -> complex:
        """Return the point [m]."""

    def velocity(self, u: float, /) -> complex:
        """Return its derivative by the parameter; never zero."""

    def acceleration(self, u: float, /) -> complex:
        """Return its second derivative."""


class ArcLengthCurve(Protocol):
    """A way to drive along, by its length."""

    length: float
    """[m]"""
    way: Column
    """(n,) nodes [m], not decreasing; at a joint of two curves it stands twice"""
    middle_way: Column
    """(n - 1,) a place within each cell [m]"""

    @property
    def curvature(self) -> Column:
        """(n,) at each node, left positive [1/m]."""

    @property
    def middle_curvature(self) -> Column:
        """(n - 1,) at each `middle_way` [1/m]."""

    def locate(self, way: float) -> tuple[Curve, float]:
        """Return the curve and its parameter at ``way`` [m] from the start."""


class Motion(Protocol):
    """One stretch of a trajectory, from rest or present speed to rest."""

    @property
    def duration(self) -> float:
        """Until it rests [s]."""

    @property
    def rotating(self) -> bool:
        """Whether it turns on the spot."""

    @property
    def length(self) -> float:
        """Way driven [m]."""

    @property
    def end(self) -> Pose:
        """Where it rests."""

    def pose(self, time: float) -> Pose:
        """Return the pose at ``time`` [s]; before the start and after the end, those."""

    def speeds(self, time: float) -> Speeds:
        """Return the speeds at ``time`` [s]; zero before the start and after the end."""

    def stopped(self, time: float) -> Motion:
        """Return the same motion until ``time`` [s], then braked to rest."""
