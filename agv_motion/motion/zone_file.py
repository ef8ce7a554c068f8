"""Zones from files: YAML of our own, or GeoJSON from a drawing program."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import yaml

from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.motion.polar import PLATFORM_RADIUS
from agv_motion.motion.zone import MARGIN, Zone

KINDS = {'zone': 'Polygon', 'translation_only': 'Polygon', 'home': 'Point'}
"""What a feature of a GeoJSON drawing may be, and its form."""

KEYS = ('boundary', 'holes', 'translation_only', 'margin', 'clearance_from', 'home')

CLEARANCES = ('rim', 'centre')
"""What the margin may count from: the rim of the platform, or its centre, as the ancestor's did."""

DEGREES = 1.0
"""No zone is so small in metres; one in degrees is smaller yet."""


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
        GeometryError: What it holds is no zone; the message names the file.

    """
    path = Path(path)
    geojson = path.suffix.lower() in {'.json', '.geojson'}
    try:
        text = path.read_text(encoding='utf-8')
        content = json.loads(text) if geojson else yaml.safe_load(text)
    except (OSError, ValueError, yaml.YAMLError) as error:
        msg = f"cannot read the zone '{path}': {error}"
        raise ConfigurationError(msg) from error
    try:
        return _zone(_from_geojson(content) if geojson else content, rim)
    except ConfigurationError as error:
        msg = f'{path}: {error}'
        raise ConfigurationError(msg) from error
    except (GeometryError, TypeError, KeyError, ValueError, AttributeError) as error:
        msg = f'{path}: {error}'
        raise GeometryError(msg) from error


def _zone(keys: Any, rim: float) -> Zone:
    """Return the zone of the keys of a file.

    Raises:
        ConfigurationError: One is missing, or is none of ours.
        GeometryError: They hold no zone.

    """
    if not isinstance(keys, dict) or 'boundary' not in keys or set(keys) - set(KEYS):
        given = ', '.join(map(str, keys)) if isinstance(keys, dict) else repr(keys)[:80]
        msg = f'expected boundary, and of {", ".join(KEYS[1:])}; got {given}'
        raise ConfigurationError(msg)
    for key in ('holes', 'translation_only'):
        if not isinstance(keys.get(key) or [], list):
            msg = f'{key} must be a list of lists of [x, y], got {keys[key]!r:.80}'
            raise GeometryError(msg)
    clearance_from = keys.get('clearance_from', 'rim')
    if clearance_from not in CLEARANCES:
        msg = f"clearance_from = '{clearance_from!s:.80}': choose one of {', '.join(CLEARANCES)}"
        raise ConfigurationError(msg)
    return Zone(
        keys['boundary'],
        keys.get('holes') or (),
        keys.get('translation_only') or (),
        float(keys.get('margin', MARGIN)),
        keys.get('home'),
        rim=rim if clearance_from == 'rim' else 0.0,
    )


def _from_geojson(content: Any) -> dict[str, Any]:
    """Return the features of a drawing under the keys of our own files.

    Raises:
        ConfigurationError: A feature is of no kind that a zone has, or there are two zones.

    """
    features = content.get('features', [content]) if isinstance(content, dict) else []
    keys: dict[str, Any] = {'holes': [], 'translation_only': []}
    for i, feature in enumerate(features):
        kind = (feature.get('properties') or {}).get('kind', 'zone')
        geometry = feature.get('geometry', feature) or {}
        form = geometry.get('type')
        if KINDS.get(kind) != form or (kind == 'zone' and 'boundary' in keys):
            msg = (
                f"feature {i + 1} is a {form} of kind '{kind}': expected one Polygon of kind zone, "
                'Polygons of kind translation_only, a Point of kind home'
            )
            raise ConfigurationError(msg)
        if kind == 'home':
            keys['home'] = geometry['coordinates'][:2]
        elif kind == 'translation_only':
            keys['translation_only'].append(geometry['coordinates'][0])
        else:
            keys['boundary'], *keys['holes'] = geometry['coordinates']
            given = feature.get('properties') or {}
            keys |= {key: given[key] for key in ('margin', 'clearance_from') if key in given}
            _require_metres(keys['boundary'])
    return keys


def _require_metres(boundary: Any) -> None:
    """Refuse a boundary in degrees of longitude and latitude, as most drawing programs export it.

    Raises:
        ConfigurationError: All of it lies within a degree, and within what degrees there are.

    """
    columns = [[float(value) for value in column] for column in zip(*boundary, strict=True)][:2]
    (west, south), (east, north) = map(min, columns), map(max, columns)
    if max(east - west, north - south) < DEGREES and abs(west) <= 180.0 and abs(south) <= 90.0:
        msg = (
            f'its coordinates look like degrees (longitude {west:g} to {east:g}, latitude '
            f'{south:g} to {north:g}): a zone is in metres of the map; export it in a metric '
            'system such as UTM and take off the place of the origin of the map'
        )
        raise ConfigurationError(msg)
