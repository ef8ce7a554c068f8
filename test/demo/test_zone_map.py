"""A map of characters is cheap to send."""

from __future__ import annotations

import io

import pytest

pytest.importorskip('rclpy')

from rich.console import Console
from rich.text import Text

from agv_motion.demo.zone_map import ZoneMap


def test_a_map_is_few_bytes_on_a_slow_line(zone):
    """Cells of one style go together: a style for each cell took six times the bytes."""
    console = Console(width=80, file=io.StringIO(), force_terminal=True, color_system='256')
    drawn = ZoneMap(zone, 48, 20)
    marks = {(3, 4): ('•', 'green'), (3, 5): ('•', 'green'), (9, 9): ('♣', 'bold green')}
    console.print(drawn.text(marks, lambda x, _: '░' if x > 8.0 else ' '))
    told = console.file.getvalue()
    assert len(told) < 2.5 * drawn.rows * drawn.columns
    assert Text.from_ansi(told).plain.rstrip('\n').count('░') > 100
