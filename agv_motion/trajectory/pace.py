"""How far the robot is behind its Ghost, and whether the Ghost goes on, dawdles, waits or gives up.

Between slow and wait the Ghost's pace falls from 1 to 0, and it changes no faster than the robot
can follow: the Ghost waits for the robot without a jump of speed.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING, Annotated

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check

if TYPE_CHECKING:
    from agv_motion.trajectory.tracking import TrackingError


SLOWEST = 0.1
"""A Ghost that would dawdle at a smaller pace waits: it would only ever nearly come to rest."""


@dataclass(frozen=True)
class PaceParameters:
    """Distances between robot and Ghost, in their order."""

    slow_beyond: Annotated[float, Spec('the Ghost dawdles', 'm', (1e-3, 100.0), dynamic=True)] = (
        0.10
    )
    wait_beyond: Annotated[float, Spec('the Ghost waits', 'm', (1e-3, 100.0), dynamic=True)] = 0.25
    lost_beyond: Annotated[
        float, Spec('the robot is lost: stop', 'm', (1e-3, 100.0), dynamic=True)
    ] = 0.60
    heading_arm: Annotated[
        float,
        Spec(
            'distance that counts as much as a heading error of one radian',
            'm/rad',
            (0.0, 10.0),
            dynamic=True,
        ),
    ] = 0.15
    ease: Annotated[
        float,
        Spec(
            'time in which the Ghost comes from full pace to waiting',
            's',
            (0.01, 10.0),
            dynamic=True,
        ),
    ] = 0.5

    def __post_init__(self) -> None:
        """Check every row, and the order."""
        check(self)
        if not self.slow_beyond < self.wait_beyond < self.lost_beyond:
            msg = (
                f'slow_beyond = {self.slow_beyond} m, wait_beyond = {self.wait_beyond} m, '
                f'lost_beyond = {self.lost_beyond} m: give them in this order, rising'
            )
            raise ConfigurationError(msg)


class PaceController:
    """The pace of the Ghost, in [0, 1]."""

    def __init__(self, parameters: PaceParameters | None = None) -> None:
        """Start at rest."""
        self.parameters = parameters or PaceParameters()
        self.pace = 0.0
        """Share of time that passes for the Ghost"""

    def restart(self, *, moving: bool) -> None:
        """Set the pace at once, for a Ghost that stands: its trajectory has a ramp of its own."""
        self.pace = 1.0 if moving else 0.0

    def separation(self, error: TrackingError) -> float:
        """Return how far apart robot and Ghost are, heading included [m]."""
        arm = self.parameters.heading_arm
        return hypot(error.along, error.across) + arm * abs(error.heading)

    def is_lost(self, separation: float) -> bool:
        """Return whether the robot is too far away to go on."""
        return separation >= self.parameters.lost_beyond

    def ease(self, separation: float, dt: float, *, hold: bool = False) -> float:
        """Return the pace for the next ``dt`` [s], eased towards what ``separation`` [m] allows.

        Args:
            separation: Between robot and Ghost.
            dt: Time until the next call.
            hold: Whether to come to a halt in any case.

        """
        given = self.parameters
        room = (given.wait_beyond - separation) / (given.wait_beyond - given.slow_beyond)
        wanted = 0.0 if hold or room < SLOWEST else min(room, 1.0)
        step = dt / given.ease
        self.pace += min(max(wanted - self.pace, -step), step)
        return self.pace
