"""Labels of a figure, moved apart once its layout is known.

Whoever draws marks a text by its ``gid`` as one of three kinds; `settle` does the rest.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.text import Annotation, Text

SETTLING = 200
"""Steps in which labels are pushed apart."""

ROW = 11.0
"""Height of a row of events [points]."""

END, EVENT, NAME = 'label at the end', 'event', 'name'

ROOMS: WeakKeyDictionary[Text, list[tuple[float, float, str]]] = WeakKeyDictionary()
"""Where each name may stand, x, y and its side, the place with most room first."""


def settle(figure: Any) -> None:
    """Move labels apart, once the layout is known: at line ends in height, events in rows."""
    _lay_out(figure)
    renderer = figure.canvas.get_renderer()
    for text in figure.texts:
        wide = text.get_window_extent(renderer).width / (0.97 * figure.bbox.width)
        text.set_fontsize(text.get_fontsize() / max(wide, 1.0))
    stacked = False
    for axes in figure.axes:
        texts = [text for text in axes.texts if text.get_gid() == END]
        _spread(texts, axes.bbox, figure.dpi / 72.0, renderer)
        events = [text for text in axes.texts if text.get_gid() == EVENT]
        _stack(events, axes.get_title('left'), figure, renderer)
        stacked |= len(events) > 1
    if stacked:
        _lay_out(figure)  # rows of events have made the axes smaller
    for axes in figure.axes:
        for name in [text for text in axes.texts if text.get_gid() == NAME]:
            _find_room(name, axes, renderer)


def _lay_out(figure: Any) -> None:
    """Place the axes as drawing would: that costs as much again, and comes once, in the end."""
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
    for axes in figure.axes:
        axes.apply_aspect()


def _find_room(name: Text, axes: Axes, renderer: Any) -> None:
    """Move a name to the first of its places that is inside the axes and on no other text."""
    others = [
        text.get_window_extent(renderer).expanded(1.1, 1.1)
        for text in axes.texts
        if text is not name
    ]
    best, least = ROOMS[name][0], np.inf
    for place in ROOMS[name]:
        name.set(x=place[0], y=place[1], ha=place[2])
        box = name.get_window_extent(renderer)
        out = max(axes.bbox.x0 - box.x0, box.x1 - axes.bbox.x1, 0.0)
        out += max(axes.bbox.y0 - box.y0, box.y1 - axes.bbox.y1, 0.0)
        bad = out + 20.0 * box.count_overlaps(others)
        if bad < least:
            best, least = place, bad
        if not bad:
            return
    name.set(x=best[0], y=best[1], ha=best[2])  # no room anywhere: where it harms least


def _spread(texts: list[Annotation], inside: Any, pixels: float, renderer: Any) -> None:
    """Push labels that overlap apart, half a step each, in their order, and inside the axes."""
    boxes = [text.get_window_extent(renderer) for text in texts]
    order = sorted(range(len(texts)), key=lambda i: boxes[i].y0)
    low = np.array([boxes[i].y0 for i in order])
    if not len(low):
        return
    heights = np.array([boxes[i].height for i in order])
    low = np.clip(low, inside.y0 - 0.5 * heights, inside.y1 - 0.5 * heights)
    for _ in range(SETTLING):
        for i in range(1, len(low)):
            over = low[i - 1] + boxes[order[i - 1]].height + 2.0 - low[i]
            if over > 0.0:
                low[i - 1 : i + 1] += (-0.5 * over, 0.5 * over)
    low += max(inside.y0 - 0.5 * heights[0] - low[0], 0.0)
    low -= max(low[-1] + 0.5 * heights[-1] - inside.y1, 0.0)
    for i, place in zip(order, low, strict=True):
        texts[i].xyann = (texts[i].xyann[0], (place - boxes[i].y0) / pixels)


def _stack(texts: list[Annotation], title: str, figure: Any, renderer: Any) -> None:
    """Move events that overlap into the row above, and into the figure if they reach beyond."""
    rows: list[float] = []
    pixels = figure.dpi / 72.0
    lowest = 4.0 + (1.5 * ROW if title else 0.0)
    for text in sorted(texts, key=lambda text: text.xy[0]):
        box = text.get_window_extent(renderer)
        over = max(box.x1 - (figure.bbox.x1 - 8.0), 0.0)
        row = next((i for i, end in enumerate(rows) if end + 6.0 < box.x0 - over), len(rows))
        rows[row : row + 1] = [box.x1 - over]
        text.xyann = (-over / pixels, lowest + row * ROW)
