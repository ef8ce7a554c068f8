"""Routes from files: YAML, or CSV as a spreadsheet or a logger writes it."""

from __future__ import annotations

import re
from math import isfinite, nan
from pathlib import Path

from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.files import text, yaml_text
from agv_motion.files.marked import quoted
from agv_motion.route.route import Route

KEYS = ('waypoints', 'laps')
_NUMBER = re.compile(r'[-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?')


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
        ConfigurationError: The file cannot be read or holds no route; the message names file, line
            and column.

    """
    path = Path(path)
    if path.suffix.lower() in {'.yaml', '.yml'}:
        points, laps = _from_yaml(path, laps)
    else:
        points = _from_csv(path, text.read(path, 'the route'))
    try:
        return Route(points, laps)
    except GeometryError as error:
        raise ConfigurationError.at((path, 1, 1), str(error), str(error)) from error


def _from_yaml(path: Path, laps: int) -> tuple[list[tuple[float, float]], int]:
    file = yaml_text.load(path, 'the route')
    expected = 'expected waypoints and, if wanted, laps'
    content = file.value
    if not isinstance(content, dict) or 'waypoints' not in content or set(content) - set(KEYS):
        given = ', '.join(content) if isinstance(content, dict) else quoted(content)
        file.refuse(f'{expected}; got {given:.80}', expected)
    found = file.mapping('the route')
    points = [
        pair.point(f'waypoint {number}')
        for number, pair in enumerate(found['waypoints'][1].items('waypoints'), 1)
    ]
    return points, found['laps'][1].typed('laps', int) if 'laps' in found else laps


def _from_csv(path: Path, content: str) -> list[tuple[float, float]]:
    points: list[tuple[float, float]] = []
    columns: tuple[int, int] | None = None
    for number, line in enumerate(content.split('\n'), 1):
        fields = _fields(line.split('#')[0])
        if not fields:
            continue
        names = [name.strip('"').lower() for name, _ in fields]
        if columns is None and 'x' in names and 'y' in names:
            columns = names.index('x'), names.index('y')
            continue
        if columns is None and len(fields) != 2:
            reason = 'no pair; name the columns x and y'
            where = (path, number, fields[-1][1])
            raise ConfigurationError.at(where, f'{quoted(line.strip())} is {reason}', reason)
        columns = columns or (0, 1)
        points.append(_point(path, number, line, fields, columns))
    return points


def _point(
    path: Path, number: int, line: str, fields: list[tuple[str, int]], columns: tuple[int, int]
) -> tuple[float, float]:
    """Return x and y of a line.

    Raises:
        ConfigurationError: They are missing, or no finite numbers.

    """
    values = []
    for column in columns:
        word, at = fields[column] if column < len(fields) else ('', len(line) + 1)
        value = float(word) if _NUMBER.fullmatch(word) else nan
        if not isfinite(value):
            reason = 'gives no x and y in metres: both must be finite numbers'
            finding = f'{quoted(line.strip())} {reason}'
            raise ConfigurationError.at((path, number, at), finding, reason)
        values.append(value)
    return values[0], values[1]


def _fields(line: str) -> list[tuple[str, int]]:
    """Split at the first of semicolon, tab and comma that the line has, else at blanks.

    Each field comes with its column, counted from 1.
    """
    if not line.strip():
        return []
    separator = next((sign for sign in ';\t,' if sign in line), None)
    if separator is None:
        return [(found[0], found.start() + 1) for found in re.finditer(r'\S+', line)]
    fields, at = [], 1
    for field in line.split(separator):
        fields.append((field.strip(), at + len(field) - len(field.lstrip())))
        at += len(field) + 1
    return fields
