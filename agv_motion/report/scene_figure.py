"""The scene of a bag as RViz and Foxglove show it: its very markers, and the robots' models.

Everything is drawn from what the bag holds, seen obliquely from the south; nothing is added but a
list of the namespaces. No tool of others and no browser is needed.
"""

from __future__ import annotations

from math import cos, radians, sin
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.bag.message_objects import decoded
from agv_motion.errors import ConfigurationError
from agv_motion.model.footprint import solids
from agv_motion.report import style
from agv_motion.report.figure import figure
from agv_motion.report.recorded_footprint import read_model
from agv_motion.report.stamped_columns import POSES, pose_columns, topics_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from pathlib import Path

    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from agv_motion.bag.reader import BagReader

    Array = NDArray[np.float64]

MARKERS = 'visualization_msgs/msg/MarkerArray'
ADD, DELETE, DELETE_ALL = 0, 2, 3
ARROW, LINE_STRIP, LINE_LIST, TEXT, TRIANGLES = 0, 4, 5, 9, 11
"""Kinds of visualization_msgs/Marker that are drawn; others are passed over."""

KINDS = frozenset((ARROW, LINE_STRIP, LINE_LIST, TEXT, TRIANGLES))

ELEVATION = radians(52.0)
"""[rad] From which the floor is looked at"""
SEEN_FROM = 0.5
"""Opacity of a robot's model: what lies under it is seen, too."""
LUMINANCE, READABLE = (0.2126, 0.7152, 0.0722), 0.4
"""Of red, green and blue (ITU-R BT.709), and by how much words differ from the paper at least"""
SHAPE = 2.1
"""Width over height of the picture, at least"""
AROUND = 1.5
"""[m] around robots, ways and goals that the picture shows of the zone"""


class SceneMarker(NamedTuple):
    """A marker as it was told; all places in the map [m]."""

    namespace: str
    kind: int
    points: Array
    """(n, 3)"""
    color: tuple[float, float, float, float]
    width: float
    """[m] of lines, height of words"""
    text: str


class Solid(NamedTuple):
    """A convex part of a robot's model."""

    corners: Array
    """(n, 3) in the map [m]"""
    color: tuple[float, float, float, float]


class RecordedScene(NamedTuple):
    """What is to be seen at an instant."""

    markers: list[SceneMarker]
    solids: list[Solid]


def read_scene(bag: BagReader, seconds: float) -> RecordedScene:
    """Return the scene of all robots at an instant.

    Args:
        bag: Open.
        seconds: Since the start of the bag.

    Raises:
        SourceError: The bag is damaged.
        ConfigurationError: Nobody told a scene until then.

    """
    topics = [topic for topic in topics_of(bag, [MARKERS]) if topic.endswith('/scene')]
    shown: dict[tuple[str, str, int], SceneMarker] = {}
    for message, content in decoded(bag, topics):
        if message.stamp - bag.start > seconds * 1e9:
            break
        for marker in content.markers:
            key = message.connection.topic, marker.ns, marker.id
            if marker.action == ADD and marker.type in KINDS:
                shown[key] = _marker(marker)
            elif marker.action == DELETE:
                shown.pop(key, None)
            elif marker.action == DELETE_ALL:
                shown.clear()
    if not shown:
        msg = f'{bag.path}: nobody told a scene in the first {seconds:g} s'
        raise ConfigurationError(msg)
    parts = [part for topic in topics for part in _robot(bag, topic, seconds)]
    return RecordedScene(list(shown.values()), parts)


def draw(scene: RecordedScene, title: str, path: Path, *, theme: str = 'light') -> None:
    """Draw a scene into a picture.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    with figure(path, [['scene']], theme=theme, figsize=(style.WIDTH, 5.4)) as axes:
        each = axes['scene']
        style.title(each, title)
        each.set(aspect='equal', xticks=[], yticks=[])
        each.spines[:].set_visible(False)
        _frame(each, scene.markers)
        for solid in sorted(scene.solids, key=lambda solid: float(solid.corners[:, 2].mean())):
            _draw_solid(each, solid)
        scale = _points_a_metre(each)
        for marker in scene.markers:
            _draw_marker(each, marker, scale)
        _name_namespaces(each, scene.markers)


def seen(points: Any) -> Array:
    """Return (n, 2) where points, (n, 3) in the map [m], lie on the picture."""
    x, y, z = np.asarray(points, dtype=float).reshape(-1, 3).T
    return np.array([x, sin(ELEVATION) * y + cos(ELEVATION) * z]).T


def _marker(marker: Any) -> SceneMarker:
    at = marker.pose.position
    points = [(p.x, p.y, p.z) for p in marker.points] or [(at.x, at.y, at.z)]
    c = marker.color
    return SceneMarker(
        marker.ns, marker.type, np.array(points), (c.r, c.g, c.b, c.a), marker.scale.x, marker.text
    )


def _robot(bag: BagReader, topic: str, seconds: float) -> Iterable[Solid]:
    """Yield the parts of the robot whose scene is on a topic, where it believed to be."""
    space = topic.removesuffix('/scene')
    model, there = read_model(bag, topic), topics_of(bag, POSES)
    told = next((f'{space}/{n}' for n in ('pose', 'fix') if f'{space}/{n}' in there), None)
    if model is None or told is None:
        return
    (columns,) = pose_columns(bag, [told])
    if not len(columns.stamp):
        return
    row = max(int(np.searchsorted(columns.stamp, bag.start * 1e-9 + seconds)) - 1, 0)
    x, y, heading = columns.pose[:, row].tolist()
    turn = np.array([[cos(heading), sin(heading)], [-sin(heading), cos(heading)]])
    for corners, color in solids(model):
        places = np.array(corners)
        places[:, :2] = places[:, :2] @ turn + (x, y)
        yield Solid(places, color)


def _frame(axes: Axes, markers: Sequence[SceneMarker]) -> None:
    """Let the picture hold all but the zone and what is far away, and some floor around it."""
    wide = {'zone', 'margin', 'holes', 'delicate', 'icr'}
    near = [seen(marker.points) for marker in markers if marker.namespace not in wide]
    places = np.concatenate(near or [seen(marker.points) for marker in markers])
    (west, south), (east, north) = places.min(axis=0) - AROUND, places.max(axis=0) + AROUND
    wider = 0.5 * max(SHAPE * (north - south) - (east - west), 0.0)
    axes.set(xlim=(west - wider, east + wider), ylim=(south, north))


def _points_a_metre(axes: Axes) -> float:
    """Return how many points of ink a metre is, about: before the layout is settled."""
    (west, east), (south, north) = axes.get_xlim(), axes.get_ylim()
    width, height = axes.bbox.width, axes.bbox.height
    pixels = min(width / (east - west), height / (north - south))
    return 72.0 * float(pixels / axes.figure.dpi)


def _draw_solid(axes: Axes, solid: Solid) -> None:
    from matplotlib.patches import Polygon
    from shapely import MultiPoint

    hull = MultiPoint(seen(solid.corners)).convex_hull
    if hull.geom_type == 'Polygon':
        axes.add_patch(Polygon(
            np.array(hull.exterior.coords), fc=(*solid.color[:3], SEEN_FROM), ec=style.paper(),
            lw=0.4, zorder=3.0,
        ))  # fmt: skip


def _draw_marker(axes: Axes, marker: SceneMarker, scale: float) -> None:
    """Draw a marker in the way of its kind, its widths to scale but never too thin to be seen."""
    from matplotlib.patches import Polygon

    places, color = seen(marker.points), _on_paper(marker.color)
    width = max(marker.width * scale, 0.8)
    order = 2.0 if marker.points[:, 2].max() < 1.0 else 5.0
    options = {'color': color, 'lw': width, 'zorder': order, 'gid': marker.namespace}
    if marker.kind == LINE_STRIP:
        axes.plot(*places.T, **options)
    elif marker.kind == LINE_LIST:
        for i in range(0, len(places) - 1, 2):
            axes.plot(*places[i : i + 2].T, **options)
    elif marker.kind == ARROW:
        axes.annotate('', places[1], places[0], annotation_clip=True, gid=marker.namespace,
                      arrowprops={'arrowstyle': '-|>', 'color': color, 'lw': width,
                                  'mutation_scale': 4.0 * width + 4.0}, zorder=order)  # fmt: skip
    elif marker.kind == TRIANGLES:
        for area in _areas(places):
            axes.add_patch(Polygon(area, fc=color, ec='none', zorder=1.0, gid=marker.namespace))
    elif marker.kind == TEXT:
        axes.text(
            places[0, 0], places[0, 1], marker.text, color=_readable(color),
            fontsize=style.TEXT, ha='center', va='bottom',
            zorder=6.0, gid=marker.namespace, clip_on=True,
            bbox={'facecolor': style.paper(), 'edgecolor': 'none', 'alpha': 0.7, 'pad': 1.0},
        )  # fmt: skip


def _areas(corners: Array) -> Iterator[Array]:
    """Yield the outlines of what triangles, three corners each, fill together."""
    import shapely

    triangles = corners[: len(corners) // 3 * 3].reshape(-1, 3, 2)
    whole = shapely.union_all(shapely.polygons(triangles))
    for part in getattr(whole, 'geoms', [whole]):
        if part.geom_type == 'Polygon':
            yield np.array(part.exterior.coords)


def _on_paper(color: tuple[float, float, float, float]) -> Any:
    """Return a colour as it is; what is as dark as the paper, in ink."""
    from matplotlib.colors import to_rgb

    apart = np.abs(np.array(color[:3]) - np.array(to_rgb(style.paper()))).max()
    return (*to_rgb(style.ink()), color[3]) if apart < 0.2 else color


def _readable(color: Any) -> Any:
    """Return a colour that words can be read in on the paper: as it is, or ink."""
    from matplotlib.colors import to_rgb

    light = [np.dot(to_rgb(each), LUMINANCE) for each in (color, style.paper())]
    return color if abs(light[0] - light[1]) > READABLE else style.ink()


def _name_namespaces(axes: Axes, markers: Sequence[SceneMarker]) -> None:
    """List the namespaces below, each in the colour of its markers: each can be left out."""
    from matplotlib.lines import Line2D

    colors = {marker.namespace: _on_paper(marker.color) for marker in markers}
    axes.figure.legend(
        handles=[Line2D([], [], color=c, lw=3.0, label=name) for name, c in colors.items()],
        loc='outside lower left', ncols=7,
    )  # fmt: skip
