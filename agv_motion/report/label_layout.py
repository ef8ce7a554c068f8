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
    figure.draw_without_rendering()
    renderer = figure.canvas.get_renderer()
    for text in figure.texts:
        wide = text.get_window_extent(renderer).width / (0.97 * figure.bbox.width)
        text.set_fontsize(text.get_fontsize() / max(wide, 1.0))
    for axes in figure.axes:
        texts = [text for text in axes.texts if text.get_gid() == END]
        _spread(texts, figure.dpi / 72.0, renderer)
        for name in [text for text in axes.texts if text.get_gid() == NAME]:
            _find_room(name, axes, renderer)
        _stack([text for text in axes.texts if text.get_gid() == EVENT], figure, renderer)


def _find_room(name: Text, axes: Axes, renderer: Any) -> None:
    """Move a name to the first of its places that is inside the axes and on no other text."""
    others = [
        text.get_window_extent(renderer).expanded(1.1, 1.1)
        for text in axes.texts
        if text is not name
    ]
    for x, y, side in ROOMS[name]:
        name.set(x=x, y=y, ha=side)
        box = name.get_window_extent(renderer)
        inside = axes.bbox.x0 < box.x0 and box.x1 < axes.bbox.x1
        inside = inside and axes.bbox.y0 < box.y0 and box.y1 < axes.bbox.y1
        if inside and not box.count_overlaps(others):
            return


def _spread(texts: list[Annotation], pixels: float, renderer: Any) -> None:
    """Push labels that overlap apart, half a step each, in their order."""
    boxes = [text.get_window_extent(renderer) for text in texts]
    order = sorted(range(len(texts)), key=lambda i: boxes[i].y0)
    low = np.array([boxes[i].y0 for i in order])
    for _ in range(SETTLING):
        for i in range(1, len(low)):
            over = low[i - 1] + boxes[order[i - 1]].height + 2.0 - low[i]
            if over > 0.0:
                low[i - 1 : i + 1] += (-0.5 * over, 0.5 * over)
    for i, place in zip(order, low, strict=True):
        texts[i].xyann = (texts[i].xyann[0], (place - boxes[i].y0) / pixels)


def _stack(texts: list[Annotation], figure: Any, renderer: Any) -> None:
    """Move events that overlap into the row above, and into the figure if they reach beyond."""
    rows: list[float] = []
    pixels = figure.dpi / 72.0
    for text in sorted(texts, key=lambda text: text.xy[0]):
        box = text.get_window_extent(renderer)
        over = max(box.x1 - (figure.bbox.x1 - 8.0), 0.0)
        row = next((i for i, end in enumerate(rows) if end + 6.0 < box.x0 - over), len(rows))
        rows[row : row + 1] = [box.x1 - over]
        text.xyann = (-over / pixels, 4.0 + row * ROW)
