"""The picture of a run: beside its Ghost, beside its way, of any kind."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.bag.notes import Note
from agv_motion.kinematics.differential_platform import DifferentialBaseParameters
from agv_motion.model.footprint import footprint
from agv_motion.model.robots import differential_model
from agv_motion.report import errors_between, robot_drawing
from agv_motion.report.recorded_footprint import moments
from agv_motion.report.run import Poses, RunBag
from agv_motion.report.run_figure import draw as draw_run
from agv_motion.report.run_figure import off_the_way

DRIVE = footprint(differential_model(DifferentialBaseParameters(), 'base_link'), {})


def straight_run(planned=None, frames=frozenset({'map'})):
    """1 m/s along x for 10 s, 3 cm left of the way that is shown."""
    time = np.linspace(0.0, 10.0, 201)
    pose = np.array([time, 0.03 + 0.0 * time, 0.0 * time]).T
    driven = Poses('/ground_truth', 'map', time, pose)
    way = np.array([[0.0, 0.0], [20.0, 0.0]])
    return RunBag(planned, driven, {'/path': [way]}, frames)


def test_a_run_beside_the_way_that_was_shown_with_its_notes(sketched, tmp_path):
    notes = Note(2_500_000_000, 'rain began'), Note(6 * 10**9, 'x' * 60)
    run = straight_run()._replace(notes=notes)
    draw_run(run, None, tmp_path / 'run.png')
    sketched.check()
    drawn, texts = sketched[-1]
    told = {text for text, _ in texts}
    assert {'10.0 m in 10 s, never more than 3 cm from the way', 'start', 'end'} <= told
    assert {'rain began', 'x' * 39 + '…'} <= told
    for axes in drawn.axes[1:]:  # all but the map
        upright = [line.get_xdata()[0] for line in axes.lines if len(set(line.get_xdata())) == 1]
        assert upright == [2.5, 6.0]
    assert any(text.endswith('arrow heads not to scale') for text in told)
    assert not bodies(drawn)
    assert off_the_way(run) == pytest.approx(np.full(201, 0.03))
    assert off_the_way(straight_run(frames=frozenset({'odom'}))) is None


def test_a_run_beside_its_ghost(sketched, tmp_path):
    """The Ghost is 4 cm ahead and the robot 3 cm left of it: 5 cm apart."""
    time = np.linspace(0.0, 10.0, 201)
    ghost = Poses('/ghost/pose', 'map', time, np.array([time + 0.04, 0.0 * time, 0.0 * time]).T)
    run = straight_run(ghost)
    draw_run(run, errors_between(ghost, run.driven), tmp_path / 'run.png', theme='dark')
    sketched.check()
    texts = [text for text, _ in sketched[-1][1]]
    assert '10.0 m in 10 s, 5.0 cm from the plan, at most 5.0 cm' in texts
    assert {'along', 'across', 'plan', 'driven'} <= set(texts)


@pytest.mark.parametrize(
    ('points', 'time'),
    [
        ([[0.0, 0.0, 0.0]] * 50, np.linspace(0.0, 10.0, 50)),  # it stands
        ([[1.0, 2.0, 0.5]], np.zeros(1)),  # one pose
        ([[0.01 * i, np.nan if i == 7 else 0.0, 0.0] for i in range(50)], np.linspace(0, 10, 50)),
        ([[0.1 * i, 0.0, 0.0] for i in range(50)], np.r_[0:25, 200:225].astype(float)),
        ([[20.0 * i, 5.0 * i, 0.0] for i in range(50)], np.linspace(0.0, 18000.0, 50)),
    ],
    ids=['stands', 'one', 'nan', 'silence', 'far'],
)
def test_runs_of_any_kind_are_drawn(sketched, tmp_path, points, time):
    driven = Poses('/pose', 'map', time, np.array(points))
    shapes = [DRIVE] * len(moments(len(time)))
    draw_run(RunBag(None, driven, {}, footprints=shapes), None, tmp_path / 'run.png')
    sketched.check()
    (drawn, texts), speed = sketched[-1], None
    speed = next(axes for axes in drawn.axes if axes.get_title('left') == 'Speed')
    if len(time) > 1:
        assert np.isfinite(speed.lines[0].get_ydata()).any()
    way = next(axes for axes in drawn.axes if axes is not speed).lines[0].get_xydata()
    assert np.isnan(way).any() == (
        len(time) > 1 and bool(np.isnan(points).any() or time[25] == 200)
    )
    assert ('start and end' in {text for text, _ in texts}) == (
        np.hypot(*(driven.pose[-1] - driven.pose[0])[:2]) < 0.01
    )


def bodies(drawn):
    return drawn.findobj(lambda artist: artist.get_gid() == robot_drawing.BODY)


def test_of_a_run_whose_size_is_known_the_robot_is_drawn_to_scale(sketched, tmp_path):
    draw_run(straight_run()._replace(footprints=[DRIVE] * 5), None, tmp_path / 'run.png')
    drawn, texts = sketched[-1]
    assert any(text.endswith('robot to scale') for text, _ in texts)
    places = sorted(float(body.get_xy()[:, 0].mean()) for body in bodies(drawn))
    assert np.array(places) == pytest.approx([0.0, 2.5, 5.0, 7.5, 10.0], abs=0.1)
