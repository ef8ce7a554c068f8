"""Pictures as they are rendered: no two texts of one overlap, and all lie inside.

The runs are recorded demos, thinned: every twentieth to every hundredth message.
"""

from __future__ import annotations

from itertools import combinations

import pytest

from agv_motion.report import figure as figure_module

WRITE = figure_module._write  # noqa: SLF001 - what is looked at is what is given to it


def texts_of(drawn):
    """Return every text that is seen, with its box [px]."""
    from matplotlib.text import Text

    renderer = drawn.canvas.get_renderer()
    seen = [text for text in drawn.findobj(Text) if text.get_text().strip() and text.get_visible()]
    ticks = {
        label
        for axes in drawn.findobj(lambda artist: hasattr(artist, 'get_xticklabels'))
        for axis in (axes.xaxis, axes.yaxis)
        for tick in (*axis.majorTicks, *axis.minorTicks)
        for label in (tick.label1, tick.label2)
    }
    shown = {
        label
        for axes in drawn.findobj(lambda artist: hasattr(artist, 'get_xticklabels'))
        for axis in (axes.xaxis, axes.yaxis)
        for tick in axis._update_ticks()  # noqa: SLF001 - there is no other way to ask
        for label in (tick.label1, tick.label2)
        if label.get_visible()
    }
    return [
        (text.get_text(), text.get_window_extent(renderer))
        for text in seen
        if text not in ticks or text in shown
    ]


class Pictures(list):
    """Figures, each with its texts and their boxes."""

    def check(self):
        """Assert that no two texts of the last figure overlap and none reaches out of it."""
        each, texts = self[-1]
        for text, box in texts:
            assert box.x0 >= 0.0, (text, box)
            assert box.y0 >= 0.0, (text, box)
            assert box.x1 <= each.bbox.x1, (text, box)
            assert box.y1 <= each.bbox.y1, (text, box)
        for (one, here), (other, there) in combinations(texts, 2):
            wide = min(here.x1, there.x1) - max(here.x0, there.x0)
            high = min(here.y1, there.y1) - max(here.y0, there.y0)
            assert min(wide, high) < 1.5, (one, other)


@pytest.fixture
def sketched(monkeypatch):
    """Return the figures as they are before they are written, which they are not."""
    pytest.importorskip('matplotlib')  # here, since it takes long where tests are only listed
    figures = Pictures()

    def looked_at(each, _path):
        each.draw_without_rendering()
        figures.append((each, texts_of(each)))

    monkeypatch.setattr(figure_module, '_write', looked_at)
    return figures


@pytest.fixture
def drawn(sketched, monkeypatch):
    """Return the same of figures that are written too."""
    look = figure_module._write  # noqa: SLF001 - as `sketched` has it

    def written(each, path):
        look(each, path)
        WRITE(each, path)

    monkeypatch.setattr(figure_module, '_write', written)
    return sketched
