"""The picture of several trees: who walked, and how near they came."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.motion.navigation.zone import Zone
from agv_motion.report.walks import RecordedWalk
from agv_motion.report.walks_figure import draw as draw_walks

RECORDED = Path(__file__).parent / 'recorded'


SQUARE = Zone([[0, 0], [20, 0], [20, 15], [0, 15]], rim=1.18)


def recorded_walks():
    with np.load(RECORDED / 'trees.npz') as held:
        return [
            RecordedWalk(
                str(name), held[f'{name}_time'], held[f'{name}_path'],
                [tuple(goal) for goal in held[f'{name}_goals']],
                [
                    (float(begin), str(doing))
                    for begin, doing in zip(
                        held[f'{name}_begins'], held[f'{name}_doings'], strict=True
                    )
                ],
                np.zeros(len(held[f'{name}_time'])),
            )
            for name in held['names']
        ]  # fmt: skip


def test_the_trees(drawn, tmp_path):
    traffic = TrafficParameters(body=1.18, margin=0.2)
    draw_walks(recorded_walks(), SQUARE, traffic, tmp_path / 'trees.png')
    drawn.check()
    texts = [text for text, _ in drawn[-1][1]]
    told = 'Three trees walk 72 metres in 40 minutes, never nearer than 0.8 m to each other'
    assert {told, 'least 0.2 m', 'oak, ash', 'start', 'gives way'} <= set(texts)
    assert (tmp_path / 'trees.png').stat().st_size < 200_000


def test_many_trees_with_long_names(sketched, tmp_path):
    """Ten gaps have no names: the least of all is drawn over them."""
    time = np.linspace(0.0, 2400.0, 50)
    trees = [
        RecordedWalk(
            f'a_tree_with_a_long_name_{i}', time, np.array([2.0 + time / 300, 1.5 * i + 0 * time]),
            [(400.0 * k, 2.0 + 2 * k, 1.5 * i) for k in range(6)], [(0.0, 'walks')], 0.0 * time,
        )
        for i in range(5)
    ]  # fmt: skip
    draw_walks(trees, SQUARE, TrafficParameters(body=1.18, margin=0.2), tmp_path / 'trees.png')
    drawn, texts = sketched[-1]
    found = [text for text, _ in texts]
    assert (
        'Five trees walk 40 metres in 40 minutes, two of them 0.9 m into each other at worst'
        in found
    )
    assert 'nearest two' in found
    assert 'a_tree_with_a_lon…' in found
    low, _ = next(axes for axes in drawn.axes if axes.get_title('left') == 'Gaps').get_ylim()
    assert low < 1.5 - 2.36
    for text, box in texts:
        assert (box.x0, box.y0) >= (0.0, 0.0), text
        assert box.x1 <= drawn.bbox.x1, text
