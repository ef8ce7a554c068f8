"""Zones from files: YAML of our own, or GeoJSON from a drawing program."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.files import json_text, yaml_text
from agv_motion.files.marked import quoted
from agv_motion.files.text import as_kind
from agv_motion.kinematics.platform import PLATFORM_RADIUS
from agv_motion.motion.navigation.zone import MARGIN, Zone

if TYPE_CHECKING:
    from collections.abc import Mapping

    from agv_motion.files.marked import Marked

    Ring = list[tuple[float, float]]
    Entries = Mapping[str, tuple[Marked, Marked]]

KINDS = {'zone': 'Polygon', 'translation_only': 'Polygon', 'home': 'Point'}
"""What a feature of a GeoJSON drawing may be, and its form."""

KEYS = ('boundary', 'holes', 'translation_only', 'margin', 'clearance_from', 'home')

CLEARANCES = ('rim', 'centre')
"""What the margin may count from: the rim of the platform, or, as once, its centre."""

DEGREES = 1.0
"""No zone is so small in metres; one in degrees is smaller yet."""


class ZoneDrawing:
    """What a file says of a zone, each part with its place."""

    def __init__(self, file: Marked) -> None:
        """Begin with nothing of ``file`` read."""
        self.file = file
        self.boundary: Marked | None = None
        self.holes: list[Marked] = []
        self.translation_only: list[Marked] = []
        self.home: Marked | None = None
        self.margin: Marked | None = None
        self.clearance_from: Marked | None = None

    def zone(
        self, rim: float, *, may_be_degrees: bool, home: tuple[float, float] | None = None
    ) -> Zone:
        """Return the zone for a platform.

        Args:
            rim: How far it reaches from its centre [m].
            may_be_degrees: Whether the drawing may be in degrees, which is refused.
            home: Where there is none in the drawing [m]; None: nowhere.

        Raises:
            ConfigurationError: There is no boundary, it is in degrees, or `clearance_from` is none
                of `CLEARANCES`.
            GeometryError: It is no zone.

        """
        if self.boundary is None:
            _unknown(self.file)
        clearance_from = self._clearance_from()
        try:
            boundary = _ring('boundary', self.boundary)
            holes = [_ring(f'hole {i}', hole) for i, hole in enumerate(self.holes, 1)]
            areas = [
                _ring(f'translation-only area {i}', area)
                for i, area in enumerate(self.translation_only, 1)
            ]
            margin = MARGIN if self.margin is None else self.margin.typed('margin', float)
            home = home if self.home is None else _position('home', self.home)
        except ConfigurationError as error:
            raise as_kind(error, GeometryError) from error
        if may_be_degrees:
            _require_metres(self.boundary, boundary)
        try:
            return Zone(
                boundary, holes, areas, margin, home, rim=rim if clearance_from == 'rim' else 0.0
            )
        except GeometryError as error:
            self._culprit(str(error)).refuse(str(error), str(error), GeometryError)

    def _clearance_from(self) -> str:
        if self.clearance_from is None:
            return 'rim'
        word: str = self.clearance_from.typed('clearance_from', str)
        if word not in CLEARANCES:
            choices = f'choose one of {", ".join(CLEARANCES)}'
            self.clearance_from.refuse(
                f'clearance_from = {quoted(word)}: {choices}', f'clearance_from: {choices}'
            )
        return word

    def _culprit(self, reason: str) -> Marked:
        """Return the part of the file with which a reason begins."""
        for name, parts in (
            ('hole', self.holes),
            ('translation-only area', self.translation_only),
        ):
            word, _, rest = reason.partition(f'{name} ')
            number = rest.split(' ', maxsplit=1)[0]
            if not word and number.isdecimal() and 0 < int(number) <= len(parts):
                return parts[int(number) - 1]
        name = reason.split(' ', maxsplit=1)[0]
        found = {'home': self.home, 'margin': self.margin, 'boundary': self.boundary}.get(name)
        return found or self.file


def load_zone(path: str | Path, rim: float = PLATFORM_RADIUS) -> Zone:
    """Return the zone of a file for a platform that reaches ``rim`` [m] from its centre.

    YAML holds ``boundary`` (a list of [x, y] in metres) and, if wanted, ``holes`` and
    ``translation_only`` (lists of such lists), ``margin`` [m], ``clearance_from`` (what the margin
    counts from: ``rim`` or ``centre``) and ``home`` ([x, y]).

    GeoJSON holds one Polygon without ``kind`` or with ``"kind": "zone"`` among its properties (its
    inner rings are the holes), others with ``"kind": "translation_only"``, and a Point with
    ``"kind": "home"``; coordinates are metres in the map. The zone's properties may hold ``margin``
    and ``clearance_from``.

    Raises:
        ConfigurationError: The file cannot be read, or has other keys.
        GeometryError: What it holds is no zone; the message names file, line and column.

    """
    path = Path(path)
    if path.suffix.lower() in {'.json', '.geojson'}:
        drawing = from_geojson(json_text.load(path, 'the zone'))
        return drawing.zone(rim, may_be_degrees=True)
    return from_yaml(yaml_text.load(path, 'the zone')).zone(rim, may_be_degrees=False)


def from_yaml(file: Marked) -> ZoneDrawing:
    """Return what YAML of our own says of a zone.

    Raises:
        ConfigurationError: It has other keys.
        GeometryError: A list is none.

    """
    content = file.value
    if not isinstance(content, dict) or 'boundary' not in content or set(content) - set(KEYS):
        _unknown(file)
    drawing = ZoneDrawing(file)
    for key, (_, value) in file.mapping('the zone').items():
        if value.value is None and key in {'holes', 'translation_only', 'home'}:
            continue
        if key not in {'holes', 'translation_only'}:
            setattr(drawing, key, value)
        else:
            try:
                setattr(drawing, key, value.items(key))
            except ConfigurationError as error:
                raise as_kind(error, GeometryError) from error
    return drawing


def from_geojson(file: Marked) -> ZoneDrawing:
    """Return the features of a drawing.

    Raises:
        ConfigurationError: A feature is of no kind that a zone has, or there are two zones.

    """
    whole = file.mapping('the drawing')
    features = whole['features'][1].items('features') if 'features' in whole else [file]
    drawing = ZoneDrawing(file)
    for number, feature in enumerate(features, 1):
        found = feature.mapping(f'feature {number}')
        properties = _inner(found, 'properties')
        kind = properties['kind'][1].value if 'kind' in properties else 'zone'
        geometry = _inner(found, 'geometry') if 'geometry' in found else found
        form = geometry['type'][1].value if 'type' in geometry else None
        known = isinstance(kind, str) and kind in KINDS and form == KINDS[kind]
        if not known or (kind == 'zone' and drawing.boundary) or 'coordinates' not in geometry:
            expected = (
                'expected one Polygon of kind zone, Polygons of kind translation_only, a Point of '
                'kind home, each with coordinates'
            )
            got = f'feature {number} is a {form!s:.80} of kind {quoted(kind)}'
            feature.refuse(f'{got}: {expected}', f'feature {number}: {expected}')
        coordinates = geometry['coordinates'][1]
        if kind == 'home':
            drawing.home = coordinates
        elif kind == 'translation_only':
            drawing.translation_only += coordinates.items('coordinates')[:1]
        else:
            rings = coordinates.items('coordinates')
            drawing.boundary, drawing.holes = (rings or [coordinates])[0], rings[1:]
            for key in {'margin', 'clearance_from'} & set(properties):
                setattr(drawing, key, properties[key][1])
    return drawing


def _inner(found: Entries, key: str) -> Entries:
    """Return a mapping in a mapping, empty where it is missing or null."""
    if key not in found or found[key][1].value is None:
        return {}
    return found[key][1].mapping(key)


def _unknown(file: Marked) -> NoReturn:
    expected = f'expected boundary, and of {", ".join(KEYS[1:])}'
    given = ', '.join(file.value) if isinstance(file.value, dict) else quoted(file.value)
    file.refuse(f'{expected}; got {given:.200}', expected)


def _ring(name: str, ring: Marked) -> Ring:
    corners = enumerate(ring.items(name), 1)
    return [_position(f'{name}: corner {i}', corner) for i, corner in corners]


def _position(name: str, position: Marked) -> tuple[float, float]:
    """Return x and y [m]; drawing programs may add a height."""
    items = position.items(name)
    if len(items) not in {2, 3}:
        expected = 'expected [x, y] in metres'
        position.refuse(f'{name} is {quoted(position.value)}: {expected}', f'{name}: {expected}')
    return items[0].typed(f'{name}: x', float), items[1].typed(f'{name}: y', float)


def _require_metres(place: Marked, boundary: Ring) -> None:
    """Refuse a boundary in degrees of longitude and latitude, as most drawing programs export it.

    Raises:
        ConfigurationError: All of it lies within a degree, and within what degrees there are.

    """
    if not boundary:
        return
    (west, south), (east, north) = (
        [choose(values) for values in zip(*boundary, strict=True)] for choose in (min, max)
    )
    if max(east - west, north - south) < DEGREES and abs(west) <= 180.0 and abs(south) <= 90.0:
        reason = (
            f'its coordinates look like degrees (longitude {west:g} to {east:g}, latitude '
            f'{south:g} to {north:g}): a zone is in metres of the map; export it in a metric '
            'system such as UTM and take off the place of the origin of the map'
        )
        place.refuse(reason, reason)
