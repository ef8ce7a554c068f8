"""Zones to spend a season in: outdoors and indoors, with what stands in the way, from a seed."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import GeometryError
from agv_motion.kinematics.platform import PLATFORM_RADIUS
from agv_motion.motion.navigation.zone import MARGIN, Zone

if TYPE_CHECKING:
    from collections.abc import Callable

Ring = list[tuple[float, float]]

DOOR = 2.0 * PLATFORM_RADIUS + 0.2
"""[m] the narrowest door that the platform must pass: its width and 20 cm"""

WALL = 0.2
"""[m] thick"""

TIGHT = 0.09
"""[m] margin with which the platform goes through the middle of such a door"""

NARROW = 0.2
"""[m] margin indoors"""


class ZonePlan(NamedTuple):
    """What a zone is made of."""

    boundary: Ring
    holes: list[Ring]
    margin: float = MARGIN
    """[m] between the rim of the platform and every edge"""

    def zone(self, home: tuple[float, float] | None = None) -> Zone:
        """Return the zone, with ``home`` [m] in it."""
        return Zone(self.boundary, self.holes, margin=self.margin, home=home, rim=PLATFORM_RADIUS)


def square(_: random.Random) -> ZonePlan:
    """Return the outdoor zone: 300 m2 of beaten earth, nothing on it."""
    return ZonePlan(_box(0.0, 0.0, 20.0, 15.0), [])


def garden(chance: random.Random) -> ZonePlan:
    """Return 300 m2 with a pond and two benches somewhere on it."""
    width = chance.uniform(15.0, 22.0)
    depth = 300.0 / width
    holes: list[Ring] = []
    for size in (3.0, 1.6, 1.6):
        x = chance.uniform(2.5, width - 2.5 - size)
        y = chance.uniform(2.5, depth - 2.5 - size)
        holes.append(_box(x, y, x + size, y + size * chance.uniform(0.3, 1.0)))
    return ZonePlan(_box(0.0, 0.0, width, depth), holes)


def hall(chance: random.Random) -> ZonePlan:
    """Return the indoor zone: 50 m2 of concrete with a column near a wall."""
    x, y = chance.uniform(4.0, 5.4), chance.uniform(3.2, 4.0)
    return ZonePlan(_box(0.0, 0.0, 10.0, 5.0), [_box(x, y, x + 0.6, y + 0.6)], NARROW)


def rooms(chance: random.Random) -> ZonePlan:
    """Return two rooms of 7 m and 8 m, joined by a door of the least width."""
    door = chance.uniform(0.3, 6.7 - DOOR)
    wall = [
        _box(7.0, 0.0, 7.0 + WALL, door),
        _box(7.0, door + DOOR, 7.0 + WALL, 7.0),
    ]
    return ZonePlan(_box(0.0, 0.0, 15.0, 7.0), wall, TIGHT)


def house(chance: random.Random) -> ZonePlan:
    """Return three rooms in a row, joined by two doors of the least width."""
    walls = []
    for x in (6.5, 13.0):
        door = chance.uniform(0.3, 7.7 - DOOR)
        walls.append(_box(x, 0.0, x + WALL, door))
        walls.append(_box(x, door + DOOR, x + WALL, 8.0))
    return ZonePlan(_box(0.0, 0.0, 20.0, 8.0), walls, TIGHT)


ZONES: dict[str, Callable[[random.Random], ZonePlan]] = {
    'square': square,
    'garden': garden,
    'hall': hall,
    'rooms': rooms,
    'house': house,
}

MOST_TREES = {'square': 5, 'garden': 3, 'hall': 2, 'rooms': 2, 'house': 2}
"""How many trees a zone of each kind gets at the most."""


def plan_of(kind: str, seed: int) -> ZonePlan:
    """Return a plan of a kind of :data:`ZONES`, all of whose walkable floor hangs together.

    Raises:
        GeometryError: Chance finds none.

    """
    chance = random.Random(seed)  # noqa: S311 - a simulation, no secret
    for _ in range(100):
        plan = ZONES[kind](chance)
        try:
            if len(plan.zone().parts) == 1:
                return plan
        except GeometryError:  # holes that overlap
            continue
    msg = f'no zone of kind {kind} from seed {seed} hangs together'
    raise GeometryError(msg)


def _box(west: float, south: float, east: float, north: float) -> Ring:
    return [(west, south), (east, south), (east, north), (west, north)]
