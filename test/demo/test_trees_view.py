"""The picture of several trees fits into the terminal, and shows all of each."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from agv_motion.demo.trees_view import TreesView

SIZES = [(80, 24), (200, 50)]


@pytest.mark.parametrize(('columns', 'rows'), SIZES)
def test_five_trees(zone, columns, rows, heard, shown):
    names = ('oak', 'ash', 'elm', 'fir', 'yew')
    view = TreesView(heard, zone, names)
    assert len(shown(view, 0.0, columns, rows)) <= rows - 2
    for i, name in enumerate(names):
        heard.hear_tree(f'{name}/', x=3.0 + 2.0 * i)
    after = shown(view, 30.0, columns, rows)
    assert len(after) <= rows - 2
    assert max(map(len, after)) <= columns
    text = '\n'.join(after)
    assert text.count('walking to (10.00,') == 5
    assert text.count('♣') == 5
    assert 'yew     11.00   5.50 m    0°' in text
    assert '-0' not in text
