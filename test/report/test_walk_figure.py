"""The picture of a walk: its finding, its labels beside each other, what it drank."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from agv_motion.motion.navigation.zone import Zone
from agv_motion.report.walk import Remembered, WalkRun
from agv_motion.report.walk_figure import WalkLimits, finding
from agv_motion.report.walk_figure import draw as draw_walk

RECORDED = Path(__file__).parent / 'recorded'


SQUARE = Zone([[0, 0], [20, 0], [20, 15], [0, 15]], rim=1.18)


def recorded_walk():
    with np.load(RECORDED / 'tree.npz') as held:
        felt = Remembered(held['felt_x'], held['felt_y'], held['felt'])
        columns = [held[name] for name in ('path', 'flow', 'speeds', 'residual', 'goals')]
        return WalkRun(*columns, [str(reason) for reason in held['reasons']], felt, None)


def watered(run):
    """Return a walk with a midnight in it: what it drank rises, and begins again at nothing."""
    time = run.flow[:, 0]
    litres = 6.0 * (time % (0.6 * time[-1])) / time[-1]
    return run._replace(water=np.array([time, litres, litres / 3.2, 3.2 * litres]).T)


@pytest.mark.parametrize(('days', 'theme', 'drinks'), [(0.0, 'light', False), (7.0, 'dark', True)])
def test_the_walk(drawn, tmp_path, days, theme, drinks):
    run = watered(recorded_walk()) if drinks else recorded_walk()
    draw_walk(run, SQUARE, WalkLimits(1 / 30), tmp_path / 'walk.png', days=days, theme=theme)
    drawn.check()
    texts = [text for text, _ in drawn[-1][1]]
    worst = 1e3 * run.residual[:, 1].max()
    assert any(f'residual of the turrets at most {worst:.2f} mm/s, limit 20' in t for t in texts)
    assert any('day of the recording' in text for text in texts) == bool(days)
    assert {'start', 'end', 's3 places'} <= set(texts)
    assert [text for text in texts if 'Drank' in text] == [
        'Drank: 2.40 L (0.75 to 7.68) today'
    ] * drinks
    assert (tmp_path / 'walk.png').stat().st_size < 200_000


def test_what_a_walk_was_is_told_from_its_numbers():
    """Hand calculation: 3 m along x, the rim of 1 m comes from 3 m to the edge to 2 m."""
    path = np.array([[0.0, 4.0, 7.0, 0.0], [3600.0, 7.0, 7.0, 0.0]])
    flow = np.array([[i, 0.5, 0.5, 0.30 + 0.02 * i] for i in range(6)])
    run = WalkRun(path, flow, *np.empty((2, 0, 2)), np.empty((0, 3)), [], None, None)
    told = 'Three metres in an hour, towards the sun, never nearer than 3.0 m to the edge'
    assert finding(run, SQUARE, 1.0) == told
    assert 'into the shade' in finding(run._replace(flow=flow[::-1]), SQUARE, 1.0)
    assert 'in an hour that played seven days, never' in finding(run, SQUARE, 1.0, 7.0)
    nearer = run._replace(path=path - [[0.0] * 4, [0.0, 2.0, 0.0, 0.0]])
    assert finding(nearer, SQUARE, 1.0, 1.0).startswith('One metre in an hour that played one day')
    assert finding(run, SQUARE, 4.5).endswith('0.5 m over the edge at worst')


def test_long_reasons_of_many_goals_stay_beside_their_bars(sketched, tmp_path):
    time = np.linspace(0.0, 3600.0, 400)
    path = np.array([time, 3.0 + time / 300.0, 4.0 + 0.0 * time, 0.0 * time]).T
    goals = np.array([[90.0 * i, 3.0 + 0.3 * i, 4.0] for i in range(40)])
    reasons = ['asked for by somebody with a reason of many words that goes on'] * 40
    flow = np.array([time, *np.full((3, 400), 0.5)]).T
    run = WalkRun(path, flow, *np.zeros((2, 1, 2)), goals, reasons, None, None)
    draw_walk(run, SQUARE, WalkLimits(1 / 30), tmp_path / 'walk.png')
    drawn, texts = sketched[-1]
    words = [(text, box) for text, box in texts if text.startswith('asked for')]
    assert len(words) == 12
    assert 'The last 12 of 40 goals' in {text for text, _ in texts}
    edge = next(axes for axes in drawn.axes if axes.get_ylabel() == 'y [m]').bbox.x1
    for text, box in words:
        assert len(text) <= 32
        assert edge < box.x0 < box.x1 <= drawn.bbox.x1


def test_a_walk_that_is_none_is_told(sketched, tmp_path):
    path = np.array([[t, 10.0, 7.0, 0.1 * t] for t in range(0, 3601, 60)], dtype=float)
    run = WalkRun(
        path, *np.zeros((1, 1, 4)), *np.zeros((2, 1, 2)), np.empty((0, 3)), [], None, None
    )
    draw_walk(run, SQUARE, WalkLimits(1 / 30), tmp_path / 'walk.png', theme='dark')
    sketched.check()
    texts = {text for text, _ in sketched[-1][1]}
    told = 'Stands for an hour, never nearer than 5.8 m to the edge'
    assert {told, 'start and end', 'No goal was set'} <= texts
