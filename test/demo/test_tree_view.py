"""The picture of a tree fits into the terminal, and shows all that it is to show."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from std_msgs.msg import String

from agv_motion.demo.tree_view import TreeView
from agv_motion.demo.trees_view import TreesView
from agv_motion.nodes.simulator import SimulatorParameters

SIZES = [(80, 24), (200, 50)]


@pytest.mark.parametrize(('columns', 'rows'), SIZES)
def test_a_tree(zone, columns, rows, heard, shown):
    view = TreeView(heard, zone, SimulatorParameters(), drinks=True)
    before = shown(view, 0.0, columns, rows)
    heard.hear_tree()
    after = shown(view, 60.0, columns, rows)
    for picture in before, after:
        assert len(picture) <= rows - 2
        assert max(map(len, picture)) <= columns
        assert ' 0.0 times' not in '\n'.join(picture)
    text = '\n'.join(after)
    words = (
        'state', 'walking to (10.00,', 'pose     7.25   5.50 m    0°', 'wheel0', 'wheel2',
        'drank   3.21 L  1.00 to 10.30',
        'speed  ██████           0.42', ' 60.0 times real time', '♣', '✕', 'UTC',
    )  # fmt: skip
    for word in words:
        assert word in text
    assert '-0' not in text
    column = {line.index('│', 3) for line in before + after if line.startswith('│')}
    assert len(column) == 1  # nothing jumps when numbers come
    if columns > 80:
        assert len(after) > 30
        assert min(column) > 80


@pytest.mark.parametrize('litres', [(0.0, 0.0, 0.0), (99.0, 9.999, 99.99), (120.0, 99.996, 999.9),
                                    (400.0, 130.0, 1250.0)])  # fmt: skip
def test_what_it_drank_is_of_one_width_and_not_told_without_an_area(zone, litres, heard, shown):
    heard.hear_tree()
    vector = heard.messages['granier/water_use_today'].vector
    vector.x, vector.y, vector.z = litres
    view = TreeView(heard, zone, SimulatorParameters(), drinks=True)
    (line,) = [line for line in shown(view, 60.0, 80, 24) if 'drank' in line]
    told = line[line.index('drank') :].rstrip()
    assert [told.index(' L '), told.index(' to '), len(told)] == [12, 20, 29]
    known_by_nobody = TreeView(heard, zone, SimulatorParameters())
    assert 'drank' not in '\n'.join(shown(known_by_nobody, 60.0, 80, 24))


TREES = ('oak', 'ash', 'elm', 'fir', 'yew')


@pytest.mark.parametrize('names', [(), TREES[:3], TREES[:4], TREES])
def test_what_a_tree_does_is_told_whole(zone, names, heard, shown):
    for prefix in [f'{name}/' for name in names] or ['']:
        heard.hear_tree(prefix)
        state = 'walking to highest remembered sap flow 0.38 at (11.9, 11.9), felt 19 min ago'
        heard.messages[f'{prefix}state'] = String(data=state)
    view = TreesView(heard, zone, names) if names else TreeView(heard, zone, SimulatorParameters())
    text = '\n'.join(shown(view, 30.0, 80, 24))
    assert text.count('min ago') == max(len(names), 1)
    assert '…' not in text
