"""Zones from files: YAML of our own, or GeoJSON from a drawing program."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import yaml

from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.motion.zone import MARGIN, Zone

KEYS = ('boundary', 'holes', 'translation_only', 'margin', 'home')


def load_zone(path: str | Path) -> Zone:
    """Return the zone of a file.

    YAML holds ``boundary`` (a list of [x, y] in metres) and, if wanted, ``holes`` and
    ``translation_only`` (lists of such lists), ``margin`` [m] and ``home`` ([x, y]).

    GeoJSON holds one Polygon without ``kind`` or with ``"kind": "zone"`` among its properties (its
    inner rings are the holes), others with ``"kind": "translation_only"``, and a Point with
    ``"kind": "home"``; coordinates are metres in the map.

    Raises:
        ConfigurationError: The file cannot be read, or has other keys.
        GeometryError: What it holds is no zone; the message names the file.

    """
    path = Path(path)
    try:
        text = path.read_text(encoding='utf-8')
        geojson = path.suffix.lower() in {'.json', '.geojson'}
        content = json.loads(text) if geojson else yaml.safe_load(text)
    except (OSError, ValueError, yaml.YAMLError) as error:
        msg = f"cannot read the zone '{path}': {error}"
        raise ConfigurationError(msg) from error
    try:
        keys = _from_geojson(content) if geojson else content
        if not isinstance(keys, dict) or 'boundary' not in keys or set(keys) - set(KEYS):
            given = ', '.join(map(str, keys)) if isinstance(keys, dict) else repr(keys)[:80]
            msg = f'{path}: expected boundary, and of {", ".join(KEYS[1:])}; got {given}'
            raise ConfigurationError(msg)
        return Zone(
            keys['boundary'],
            keys.get('holes') or (),
            keys.get('translation_only') or (),
            float(keys.get('margin', MARGIN)),
            keys.get('home'),
        )
    except (GeometryError, TypeError, KeyError, ValueError) as error:
        if isinstance(error, ConfigurationError):
            raise
        msg = f'{path}: {error}'
        raise GeometryError(msg) from error


def _from_geojson(content: Any) -> dict[str, Any]:
    features = content.get('features', [content]) if isinstance(content, dict) else []
    keys: dict[str, Any] = {'holes': [], 'translation_only': []}
    for feature in features:
        geometry = feature.get('geometry', feature)
        kind = (feature.get('properties') or {}).get('kind', 'zone')
        if kind == 'home':
            keys['home'] = geometry['coordinates']
        elif kind == 'translation_only':
            keys['translation_only'].append(geometry['coordinates'][0])
        else:
            keys['boundary'], *keys['holes'] = geometry['coordinates']
    return keys
