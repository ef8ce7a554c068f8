"""Labels and events that would overlap are moved apart."""

from __future__ import annotations

import pytest

from agv_motion.report import figure as module
from agv_motion.report import style
from agv_motion.report.figure import figure
from agv_motion.report.label_layout import settle


def test_labels_and_events_that_would_overlap_are_moved_apart(sketched, tmp_path):
    with figure(tmp_path / 'a.png', [['a']], figsize=(6, 3)) as axes:
        style.title(axes['a'], 'a name longer than any picture is wide ' * 3)
        axes['a'].set(xlim=(0.0, 10.0), ylim=(0.0, 1.0))
        for i in range(5):
            style.line_label(axes['a'], 0.5 + 0.001 * i, f'line {i}', 'k')
            style.event(axes['a'], 4.0 + 0.1 * i, f'event {i}')
    sketched.check()


def test_a_figure_is_written_as_it_was_laid_out_for_its_labels(tmp_path, monkeypatch):
    pytest.importorskip('matplotlib')
    laid_out = []

    def look(drawn):
        settle(drawn)
        laid_out.append(drawn.axes[0].get_position().bounds)

    monkeypatch.setattr(module, 'settle', look)
    with figure(tmp_path / 'a.png', [['a']], figsize=(6, 3)) as axes:
        axes['a'].set(xlim=(0.0, 10.0), ylim=(0.0, 1.0))
        style.line_label(axes['a'], 0.5, 'a line of a long name', 'k')
    assert laid_out == [axes['a'].get_position().bounds]


@pytest.mark.parametrize('layout', ['constrained', None])
def test_a_map_is_settled_where_it_will_be_drawn(layout):
    """Of equal scales on both axes it is narrower than its place."""
    plt = pytest.importorskip('matplotlib.pyplot')
    drawn, axes = plt.subplots(figsize=(6, 3), layout=layout)
    axes.set(xlim=(0.0, 10.0), ylim=(0.0, 10.0), aspect='equal')
    settle(drawn)
    settled = axes.bbox.bounds
    drawn.set_layout_engine(None)
    drawn.draw_without_rendering()
    plt.close(drawn)
    assert settled == pytest.approx(axes.bbox.bounds)
    assert settled[2] == pytest.approx(settled[3])
