"""Routes from files: YAML, or CSV as a spreadsheet or a logger writes it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.route.route import Route

KEYS = ('waypoints', 'laps')


def load_route(path: str | Path, laps: int = 1) -> Route:
    """Return the route of a file.

    YAML holds ``waypoints`` (a list of [x, y] in metres) and, if wanted, ``laps``; any other name
    is read as CSV: x and y in metres, one waypoint a line, separated by comma, semicolon, tab or
    blanks; a first line of names, empty lines and what follows a ``#`` are passed over. With a
    first line of names the columns ``x`` and ``y`` are taken, wherever they stand.

    Args:
        path: The file.
        laps: How often to go round where the file does not say.

    Raises:
        ConfigurationError: The file cannot be read or holds no route; the message names file and,
            of CSV, line.

    """
    path = Path(path)
    try:
        text = path.read_text(encoding='utf-8')
    except (OSError, UnicodeDecodeError) as error:
        msg = f"cannot read the route '{path}': {error}"
        raise ConfigurationError(msg) from error
    if path.suffix.lower() in {'.yaml', '.yml'}:
        points, laps = _from_yaml(path, text, laps)
    else:
        points = _from_csv(path, text)
    try:
        return Route(points, laps)
    except GeometryError as error:
        msg = f'{path}: {error}'
        raise ConfigurationError(msg) from error


def _from_yaml(path: Path, text: str, laps: int) -> tuple[list[Any], int]:
    try:
        content = yaml.safe_load(text)
    except yaml.YAMLError as error:
        msg = f"cannot read the route '{path}': {error}"
        raise ConfigurationError(msg) from error
    if not isinstance(content, dict) or 'waypoints' not in content or set(content) - set(KEYS):
        given = ', '.join(map(str, content)) if isinstance(content, dict) else repr(content)[:80]
        msg = f'{path}: expected waypoints and, if wanted, laps; got {given}'
        raise ConfigurationError(msg)
    points, laps = content['waypoints'], content.get('laps', laps)
    if not isinstance(points, list) or isinstance(laps, bool) or not isinstance(laps, int):
        msg = f'{path}: waypoints must be a list of [x, y], and laps a whole number'
        raise ConfigurationError(msg)
    return points, laps


def _from_csv(path: Path, text: str) -> list[tuple[float, float]]:
    points: list[tuple[float, float]] = []
    columns: tuple[int, int] | None = None
    for number, line in enumerate(text.splitlines(), 1):
        fields = _fields(line.split('#')[0])
        if not fields:
            continue
        names = [name.strip('"').lower() for name in fields]
        if columns is None and 'x' in names and 'y' in names:
            columns = names.index('x'), names.index('y')
            continue
        if columns is None and len(fields) != 2:
            msg = f"{path}, line {number}: '{line.strip()}' is no pair; name the columns x and y"
            raise ConfigurationError(msg)
        columns = columns or (0, 1)
        try:
            points.append((float(fields[columns[0]]), float(fields[columns[1]])))
        except (ValueError, IndexError) as error:
            msg = f"{path}, line {number}: '{line.strip()}' gives no x and y in metres"
            raise ConfigurationError(msg) from error
    return points


def _fields(line: str) -> list[str]:
    """Split at the first of semicolon, tab and comma that the line has, else at blanks."""
    if not line.strip():
        return []
    for separator in ';\t,':
        if separator in line:
            return [field.strip() for field in line.split(separator)]
    return line.split()
