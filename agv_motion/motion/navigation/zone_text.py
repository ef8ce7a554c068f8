"""Zones as text: what the topic `zone` tells, and what somebody sets while a tree walks.

The text is that of a zone file, YAML or GeoJSON, and comes in by the same door.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from agv_motion.errors import AgvMotionError, ConfigurationError
from agv_motion.files import yaml_text
from agv_motion.motion.navigation.zone_file import from_geojson, from_yaml

if TYPE_CHECKING:
    from shapely import Polygon

    from agv_motion.motion.navigation.zone import Zone

WHERE = 'zone'
"""What errors call the text, before line and column."""

MOST_VALUES = 3000
"""[1] That is a thousand corners: more would keep a node that lives from its work for seconds."""

LONGEST = 200_000
"""[1] characters"""


def zone_of_text(text: str, rim: float, home: tuple[float, float] | None = None) -> Zone:
    """Return the zone that a text draws, for a platform that reaches ``rim`` [m] from its centre.

    Args:
        text: As in a zone file; JSON is YAML too.
        rim: Of the platform [m].
        home: Where the tree is parked if the text does not say [m].

    Raises:
        ConfigurationError: It cannot be read, has other keys, or is too long.
        GeometryError: What it draws is no zone; the message names line and column.

    """
    if len(text) > LONGEST:
        msg = f'zone: {len(text)} characters, at most {LONGEST}: leave out corners'
        raise ConfigurationError(msg)
    try:
        return _parsed(text, rim, home)
    except AgvMotionError as error:  # it may be quoted to whoever has sent it
        raise type(error)(str(error)) from error


def _parsed(text: str, rim: float, home: tuple[float, float] | None) -> Zone:
    file = yaml_text.parse(text, WHERE, MOST_VALUES)
    if file is None:
        msg = 'zone: the text is empty: give boundary: [[x, y], ...] in metres'
        raise ConfigurationError(msg)
    is_geojson = isinstance(file.value, dict) and 'type' in file.value
    drawing = from_geojson(file) if is_geojson else from_yaml(file)
    return drawing.zone(rim, may_be_degrees=is_geojson, home=home)


def text_of_zone(zone: Zone) -> str:
    """Return a zone as JSON of one line, from which `zone_of_text` makes the same one."""
    return json.dumps(
        {
            'boundary': _ring(zone.boundary),
            'holes': [_ring(hole) for hole in zone.holes],
            'translation_only': [_ring(area) for area in zone.translation_only],
            'margin': zone.margin,
            'clearance_from': 'rim' if zone.rim > 0.0 else 'centre',
            'home': None if zone.home is None else list(zone.home),
        }
    )


def same_floor(one: str, other: str) -> bool:
    """Return whether two texts of `text_of_zone` tell of the same boundary and holes.

    Margins, what they count from, and homes may differ among trees that share a zone.
    """
    return _floor(one) == _floor(other)


def _floor(text: str) -> tuple[Any, Any]:
    try:
        told = json.loads(text)
    except (ValueError, RecursionError):
        return None, None
    if not isinstance(told, dict):
        return None, None
    return told.get('boundary'), told.get('holes')


def _ring(polygon: Polygon) -> list[tuple[float, float]]:
    return [(x, y) for x, y in polygon.exterior.coords[:-1]]
