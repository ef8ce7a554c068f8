"""When the tree goes home: sent by someone, or early enough to be there before closing."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from math import inf
from typing import TYPE_CHECKING, Annotated

from agv_motion.activity import Cause
from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.motion.navigation.polyline import length
from agv_motion.parameters import Spec, check

if TYPE_CHECKING:
    from agv_motion.motion.navigation.path_planner import PathPlanner
    from agv_motion.motion.navigation.polyline import Point

REST_OF_WAY = 1.25
"""[-] How much longer the path home may turn out."""

LOOK_PERIOD = 60.0
"""[s] between two looks at the length of the path home."""


class OutsideZone(Enum):
    """What a tree does that stands outside its zone."""

    REFUSE = 'refuse'
    """It does not move"""
    RETURN = 'return'
    """It goes slowly to the nearest walkable point"""


@dataclass(frozen=True)
class HomeParameters:
    """How the tree goes home, and back into its zone."""

    speed: Annotated[
        float, Spec('v at least, however little sap flows: home, or to give way', '1', (0.01, 1.0))
    ] = 0.5
    arrival: Annotated[float, Spec('distance at which it is home', 'm', (0.02, 100.0))] = 0.3
    spare: Annotated[
        float, Spec('time before closing at which it wants to be there', 'min', (0.0, 600.0))
    ] = 10.0
    outside: Annotated[
        str,
        Spec(
            'outside the zone: refuse to move, or return slowly to the nearest walkable point',
            choices=tuple(each.value for each in OutsideZone),
        ),
    ] = OutsideZone.REFUSE.value
    return_speed: Annotated[float, Spec('v on that return at most', '1', (0.01, 1.0))] = 0.25

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class Homing:
    """Remembers why the tree is going home."""

    def __init__(self, planner: PathPlanner | None, parameters: HomeParameters, top: float) -> None:
        """Start with no reason to go home.

        Args:
            planner: The paths there, in a zone that may have a home; None: there is none.
            parameters: How early and how fast.
            top: Speed at v = 1 [m/s].

        """
        self.why = ''
        """Why the tree goes home, in words; empty while it does not."""
        self.because = Cause.PERSON
        """What that goes back to"""
        self._planner, self._given = planner, parameters
        self._speed = parameters.speed * top
        self._looked_at, self._distance = -inf, 0.0

    @property
    def home(self) -> Point | None:
        """Where it is [m]; None: there is none."""
        return None if self._planner is None else self._planner.zone.home

    def send(self, why: str, because: Cause = Cause.PERSON) -> None:
        """Go home and stay there.

        Raises:
            ConfigurationError: There is no home.

        """
        if self.home is None:
            msg = 'there is no home: give one in the zone file, such as home: [2.0, 2.0]'
            raise ConfigurationError(msg)
        self.why, self.because = why, because

    def is_due(self, time: float, here: Point, closing: float) -> bool:
        """Return whether the tree at ``here`` [m] must set out now to be home before closing [s].

        The path home is the shortest, a quarter longer for what may come, at the speed that the
        tree keeps on it however little sap flows.
        """
        if self.home is None or closing == inf:
            return False
        if not 0.0 <= time - self._looked_at < LOOK_PERIOD:
            self._looked_at, self._distance = time, self._length(here, self.home)
        needed = REST_OF_WAY * self._distance / self._speed
        return closing - time <= needed + 60.0 * self._given.spare

    def _length(self, here: Point, home: Point) -> float:
        """Return the length of the path home [m]; 0 if there is none."""
        assert self._planner is not None
        try:
            return length(self._planner.path(here, home))
        except GeometryError:
            return 0.0
