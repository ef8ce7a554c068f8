"""Pictures of a day as SVG: where a robot went, and what it did when."""

from __future__ import annotations

import json
from html import escape
from math import floor, isfinite, log10
from typing import TYPE_CHECKING, Any

from agv_motion.report import style

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from agv_motion.report.daily_robot import RobotDay

Ring = list[tuple[float, float]]

COLOURS = {
    'walking': style.PATH, 'driving': style.PATH, 'turning': style.OTHERS[0],
    'waiting': style.WAITING, 'paused': style.HINDERED, 'resting': '#CFCFCF',
    'closed': style.OTHERS[1], 'arrived': style.OTHERS[3], 'starting': style.SUN,
    'stopped': style.GOAL, 'blocked': style.GOAL, 'failed': style.GOAL,
}  # fmt: skip
"""of activities, as on every picture; words stand beside them"""

OTHER = '#E8E8E8'
GOALS_SHOWN = 60
WIDTH, HEIGHT = 1000.0, 36.0
"""of the bar"""


def map_of(robot: RobotDay) -> str:
    """Return zone, trail and goals as SVG; empty where nothing is known of a place."""
    edges = rings(robot.zone)
    places = [point for ring in edges.get('boundary', []) for point in ring]
    places += robot.trail + [(goal.x, goal.y) for goal in robot.goals]
    if not places:
        return ''
    (west, south), (east, north) = (
        [choose(values) for values in zip(*places, strict=True)] for choose in (min, max)
    )
    margin = 0.04 * max(east - west, north - south, 1.0)
    size = max(east - west, north - south) + 2.0 * margin
    unit = size / 100.0
    parts = [_rings(edges.get('boundary', []), '#f4f4f0', '#333333', unit)]
    parts.append(_rings(edges.get('holes', []), '#bbbbbb', '#333333', unit))
    parts.append(_rings(edges.get('translation_only', []), '#fbe3c0', '#E69F00', unit))
    if len(robot.trail) > 1:
        parts.append(
            f'<polyline points="{_points(robot.trail)}" fill="none" stroke="{style.ROBOT}" '
            f'stroke-width="{0.6 * unit:.4f}"/>'
        )
    if robot.trail:
        parts += [_end(robot.trail[0], '#ffffff', unit), _end(robot.trail[-1], style.ROBOT, unit)]
    for x, y, number in style.grouped([(g.x, g.y) for g in robot.goals], 4.5 * unit)[-GOALS_SHOWN:]:
        parts.append(_goal(number, x, -y, unit))
    parts.append(_ruler(west, south - 0.6 * margin, east - west, unit))
    width, height = east - west + 2.0 * margin, north - south + 2.0 * margin
    return (
        f'<svg viewBox="{west - margin:.3f} {-north - margin:.3f} {width:.3f} {height:.3f}" '
        f'role="img" aria-label="map: zone, way and goals of {escape(robot.name)}">'
        f'{"".join(parts)}</svg>'
    )


def bar_of(robot: RobotDay, begin: float, end: float) -> str:
    """Return the activities from ``begin`` to ``end`` [s since 1970] as a bar of SVG."""
    if end <= begin or not robot.doing.spans:
        return ''
    scale = WIDTH / (end - begin)
    parts = [f'<rect width="{WIDTH:g}" height="{HEIGHT:g}" fill="#ffffff" stroke="#333333"/>']
    for span in robot.doing.spans:
        x, width = scale * (span.begin - begin), max(scale * span.duration, 0.5)
        colour = COLOURS.get(span.activity, OTHER)
        parts.append(
            f'<rect x="{x:.2f}" width="{width:.2f}" height="{HEIGHT:g}" fill="{colour}">'
            f'<title>{escape(span.sentence)}</title></rect>'
        )
    return (
        f'<svg viewBox="0 0 {WIDTH:g} {HEIGHT:g}" preserveAspectRatio="none" class="bar" '
        f'role="img" aria-label="what {escape(robot.name)} did over the day">{"".join(parts)}</svg>'
    )


def rings(text: str) -> dict[str, list[Ring]]:
    """Return the edges of a zone that was told as JSON; what is no zone has none."""
    try:
        told = json.loads(text) if text else {}
    except (ValueError, RecursionError):
        return {}
    if not isinstance(told, dict):
        return {}
    found = {'boundary': [_ring(told.get('boundary'))]}
    for key in ('holes', 'translation_only'):
        value = told.get(key)
        found[key] = [_ring(ring) for ring in value] if isinstance(value, list) else []
    return {key: [ring for ring in value if len(ring) > 2] for key, value in found.items()}


def _ring(value: Any) -> Ring:
    return [
        (float(point[0]), float(point[1]))
        for point in (value if isinstance(value, list) else ())
        if isinstance(point, list) and len(point) > 1 and all(map(_is_number, point[:2]))
    ]


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and isfinite(value)


def _rings(edges: Iterable[Ring], fill: str, stroke: str, unit: float) -> str:
    return ''.join(
        f'<polygon points="{_points(ring)}" fill="{fill}" stroke="{stroke}" '
        f'stroke-width="{0.3 * unit:.4f}"/>'
        for ring in edges
    )


def _points(line: Sequence[tuple[float, float]]) -> str:
    return ' '.join(f'{x:.2f},{-y:.2f}' for x, y in line)


def _goal(number: str, x: float, y: float, unit: float) -> str:
    """Return a disc with the number of a goal, or the numbers of those that lie together."""
    half = (1.3 + 0.75 * len(number)) * unit
    return (
        f'<rect x="{x - half:.3f}" y="{y - 2.0 * unit:.3f}" width="{2.0 * half:.3f}" '
        f'height="{4.0 * unit:.3f}" rx="{2.0 * unit:.3f}" fill="{style.GOAL}"/>'
        f'<text x="{x:.3f}" y="{y + 0.9 * unit:.3f}" font-size="{2.6 * unit:.3f}" '
        f'font-weight="bold" fill="#ffffff" text-anchor="middle">{number}</text>'
    )


def _end(place: tuple[float, float], fill: str, unit: float) -> str:
    """Return one end of the way: a ring at the start, a disc at the end."""
    return (
        f'<circle cx="{place[0]:.3f}" cy="{-place[1]:.3f}" r="{1.4 * unit:.4f}" fill="{fill}" '
        f'stroke="{style.ROBOT}" stroke-width="{0.5 * unit:.4f}"/>'
    )


def _ruler(west: float, south: float, width: float, unit: float) -> str:
    """Return a bar of a round length below the map, with its length in metres."""
    rough = max(0.2 * width, 1e-3)
    decade = 10.0 ** floor(log10(rough))
    length = max(step * decade for step in (1.0, 2.0, 5.0) if step * decade <= rough)
    end = west + length
    return (
        f'<path d="M{west:.3f} {-south:.3f}H{end:.3f}" stroke="#1a1a1a" '
        f'stroke-width="{0.4 * unit:.4f}"/>'
        f'<text x="{end + unit:.3f}" y="{-south + 0.8 * unit:.3f}" font-size="{2.4 * unit:.3f}">'
        f'{length:g} m</text>'
    )
