"""Figures in a hurry: how they look is tried in test/report, here only whether they are there."""

from __future__ import annotations

import pytest


@pytest.fixture(autouse=True)
def figures_of_no_layout(monkeypatch):
    """Move no label and lay out no axes: that takes more than half of what a figure takes."""
    monkeypatch.setattr('agv_motion.report.figure.settle', lambda _: None)
