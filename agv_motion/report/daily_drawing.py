"""Pictures of a day as SVG: where a robot went, and what it did when."""

from __future__ import annotations

import json
from html import escape
from math import isfinite
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from agv_motion.report.daily_robot import RobotDay

Ring = list[tuple[float, float]]

COLOURS = {
    'walking': '#009E73', 'driving': '#009E73', 'turning': '#56B4E9', 'waiting': '#F0E442',
    'paused': '#E69F00', 'resting': '#0072B2', 'closed': '#999999', 'arrived': '#56B4E9',
    'starting': '#CC79A7', 'stopped': '#D55E00', 'blocked': '#D55E00', 'failed': '#D55E00',
}  # fmt: skip
"""of activities: those of Okabe and Ito, for all eyes; words stand beside them"""

OTHER = '#CCCCCC'
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
            f'<polyline points="{_points(robot.trail)}" fill="none" stroke="#0072B2" '
            f'stroke-width="{0.6 * unit:.4f}"/>'
        )
    for number, goal in list(enumerate(robot.goals, 1))[-GOALS_SHOWN:]:
        parts.append(_goal(number, goal.x, -goal.y, unit))
    if robot.trail:
        x, y = robot.trail[-1]
        parts.append(f'<circle cx="{x:.3f}" cy="{-y:.3f}" r="{1.6 * unit:.4f}" fill="#009E73"/>')
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


def _goal(number: int, x: float, y: float, unit: float) -> str:
    return (
        f'<circle cx="{x:.3f}" cy="{y:.3f}" r="{2.2 * unit:.4f}" fill="#ffffff" '
        f'stroke="#D55E00" stroke-width="{0.5 * unit:.4f}"/>'
        f'<text x="{x:.3f}" y="{y + 0.9 * unit:.3f}" font-size="{2.6 * unit:.3f}" '
        f'text-anchor="middle">{number}</text>'
    )
