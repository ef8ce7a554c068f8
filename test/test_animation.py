"""The animation of a walk: a GIF in which the tree moves; its short form, of three pictures."""

from __future__ import annotations

from contextlib import nullcontext
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip('rclpy')

from PIL import Image, ImageSequence

from agv_motion.motion.navigation.zone import Zone
from agv_motion.report.walk import WalkRun

SQUARE = Zone([[0, 0], [20, 0], [20, 15], [0, 15]], rim=1.18)


@pytest.fixture
def animation():
    """Return the script; it imports all of pyplot, so not in each process that lists the tests."""
    pytest.importorskip('matplotlib')
    import animation

    return animation


def walk():
    """An hour from 3 m to 15 m along x, towards two goals."""
    time = np.linspace(0.0, 3600.0, 241)
    path = np.array([time, 3.0 + time / 300.0, 7.0 + 0.0 * time, 0.0 * time]).T
    flow = np.array([time, *(0.3 + 1e-5 * i * time for i in (1, 2, 3))]).T
    speeds = np.array([time, *(0.001 * i * np.sin(time / 300.0) for i in (1, 2, 3))]).T
    goals = np.array([[0.0, 9.0, 7.0], [1800.0, 15.0, 7.0]])
    reasons = ['never visited: (9.0, 7.0)', 'highest sap flow 0.36 at (15.0, 7.0)']
    return WalkRun(path, flow, speeds, np.zeros((1, 2)), goals, reasons, None, None)


def test_a_walk_becomes_a_moving_picture(animation, tmp_path, monkeypatch):
    monkeypatch.setattr(animation, 'DOTS_PER_INCH', 40)
    path = tmp_path / 'walk.gif'
    animation.write(walk(), SQUARE, path, None, frames=3)
    assert path.stat().st_size < 60_000
    with Image.open(path) as gif:
        assert (gif.size, gif.info['loop']) == ((360, 156), 0)
        pictures = [np.asarray(each.convert('RGB')) for each in ImageSequence.Iterator(gif)]
    assert len(pictures) == 3
    for before, after in pairwise(pictures):
        assert 0.01 < np.mean(np.any(before != after, axis=2)) < 0.5
    left = [np.mean(blue_of_the_map(each)) for each in pictures]
    assert left == sorted(left)
    assert left[-1] - left[0] > 60  # of 12 m on a map of 20 m that is 180 pixels wide


def test_a_bag_that_does_not_tell_the_robot_is_drawn_with_a_word_about_it(
    animation, tmp_path, monkeypatch, capsys
):
    drawn = []
    monkeypatch.setattr(animation, 'read_walk', lambda *_: walk())
    monkeypatch.setattr(animation, 'read_footprints', lambda *_: None)
    monkeypatch.setattr(animation, 'write', lambda *given: drawn.append(given) or given[2].touch())
    monkeypatch.setattr(animation, 'BagReader', lambda _: nullcontext(SimpleNamespace(start=0)))
    animation.main(tmp_path / 'bag', tmp_path / 'walk.gif')
    assert drawn[0][3] is None
    (line,) = capsys.readouterr().err.splitlines()
    assert 'no robot_description' in line
    assert 'a disc of' in line
    empty = walk()._replace(path=np.empty((0, 4)))
    monkeypatch.setattr(animation, 'read_walk', lambda *_: empty)
    with pytest.raises(animation.typer.BadParameter, match='nobody tells ground_truth'):
        animation.main(tmp_path / 'bag')


def blue_of_the_map(picture):
    """Return the columns of pixels in which the robot's rim is seen on the map, at the left."""
    red, green, blue = (picture[:, :190, i].astype(int) for i in range(3))
    columns = np.flatnonzero((blue - red > 40) & (blue - green > 15)) % 190
    assert len(columns)
    return columns
