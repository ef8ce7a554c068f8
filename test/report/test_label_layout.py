"""Labels and events that would overlap are moved apart."""

from __future__ import annotations

import pytest

pytest.importorskip('matplotlib')

from agv_motion.report import style
from agv_motion.report.figure import figure


def test_labels_and_events_that_would_overlap_are_moved_apart(sketched, tmp_path):
    with figure(tmp_path / 'a.png', [['a']], figsize=(6, 3)) as axes:
        style.title(axes['a'], 'a name longer than any picture is wide ' * 3)
        axes['a'].set(xlim=(0.0, 10.0), ylim=(0.0, 1.0))
        for i in range(5):
            style.line_label(axes['a'], 0.5 + 0.001 * i, f'line {i}', 'k')
            style.event(axes['a'], 4.0 + 0.1 * i, f'event {i}')
    sketched.check()
