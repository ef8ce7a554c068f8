"""Each picture, rendered: no two texts overlap, and all lie inside.

The runs are recorded demos, thinned: every twentieth to every hundredth message.
"""

from __future__ import annotations

from importlib import import_module
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip('matplotlib')

from agv_motion.bag.notes import Note
from agv_motion.kinematics.differential_platform import DifferentialBaseParameters
from agv_motion.model.footprint import footprint
from agv_motion.model.robots import differential_model
from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.motion.navigation.zone import Zone
from agv_motion.planar import Pose
from agv_motion.probe.parameters import ProbeParameters
from agv_motion.probe.series import read_series
from agv_motion.probe.water import DayOfWater, Litres
from agv_motion.report import errors_between, label_layout, robot_drawing, style
from agv_motion.report.fields_figure import FieldLine
from agv_motion.report.fields_figure import draw as draw_fields
from agv_motion.report.figure import figure
from agv_motion.report.localization import LocalizationRun
from agv_motion.report.localization_figure import carried
from agv_motion.report.localization_figure import draw as draw_localization
from agv_motion.report.localization_figure import finding as localization_finding
from agv_motion.report.probes_figure import PlaceDays
from agv_motion.report.probes_figure import draw as draw_probes
from agv_motion.report.recorded_footprint import moments
from agv_motion.report.route_figure import draw as draw_route
from agv_motion.report.run import Poses, RunBag
from agv_motion.report.run_figure import draw as draw_run
from agv_motion.report.run_figure import off_the_way
from agv_motion.report.season_figure import FloorCoverage
from agv_motion.report.season_figure import draw as draw_season
from agv_motion.report.season_figure import finding as season_finding
from agv_motion.report.sequence_figure import draw as draw_sequence
from agv_motion.report.stamped_columns import PoseColumns
from agv_motion.report.stamped_poses import stamped_poses
from agv_motion.report.trajectory_errors import ComparisonRequest, Relation, compare
from agv_motion.report.trajectory_errors_figure import draw as draw_trajectory_errors
from agv_motion.report.trajectory_figure import draw as draw_plan
from agv_motion.report.walk import Remembered, WalkRun
from agv_motion.report.walk_figure import WalkLimits, finding
from agv_motion.report.walk_figure import draw as draw_walk
from agv_motion.report.walks import RecordedWalk
from agv_motion.report.walks_figure import draw as draw_walks
from agv_motion.ros.config import find_config
from agv_motion.route.parameters import FollowParameters
from agv_motion.route.prediction import predict as predict_route
from agv_motion.route.route_file import load_route
from agv_motion.sequence.prediction import predict as predict_sequence
from agv_motion.sequence.sequence_file import load_sequence
from agv_motion.trajectory.ghost import Ghost
from agv_motion.trajectory.ghost_parameters import GhostParameters

RECORDED = Path(__file__).parent / 'recorded'
DRIVE = footprint(differential_model(DifferentialBaseParameters(), 'base_link'), {})
SQUARE = Zone([[0, 0], [20, 0], [20, 15], [0, 15]], rim=1.18)


def texts_of(drawn):
    """Return every text that is seen, with its box [px]."""
    from matplotlib.text import Text

    renderer = drawn.canvas.get_renderer()
    seen = [text for text in drawn.findobj(Text) if text.get_text().strip() and text.get_visible()]
    ticks = {
        label
        for axes in drawn.findobj(lambda artist: hasattr(artist, 'get_xticklabels'))
        for axis in (axes.xaxis, axes.yaxis)
        for tick in (*axis.majorTicks, *axis.minorTicks)
        for label in (tick.label1, tick.label2)
    }
    shown = {
        label
        for axes in drawn.findobj(lambda artist: hasattr(artist, 'get_xticklabels'))
        for axis in (axes.xaxis, axes.yaxis)
        for tick in axis._update_ticks()  # noqa: SLF001 - there is no other way to ask
        for label in (tick.label1, tick.label2)
        if label.get_visible()
    }
    return [
        (text.get_text(), text.get_window_extent(renderer))
        for text in seen
        if text not in ticks or text in shown
    ]


@pytest.fixture
def drawn(monkeypatch):
    """Return the figures as they were settled, before they are written."""
    figures = []

    def settled(each):
        settle(each)
        each.draw_without_rendering()
        each.set_layout_engine('none')  # what is looked at here is what is written
        figures.append((each, texts_of(each)))

    settle = label_layout.settle
    monkeypatch.setattr(import_module('agv_motion.report.figure'), 'settle', settled)
    return figures


@pytest.fixture
def sketched(drawn, monkeypatch):
    """Return the same of figures whose files nobody looks at: they are written coarsely."""
    monkeypatch.setattr(import_module('agv_motion.report.figure'), 'DOTS_PER_INCH', 20)
    return drawn


def check(drawn):
    """Assert that no two texts of the last figure overlap and none reaches out of it."""
    each, texts = drawn[-1]
    for text, box in texts:
        assert box.x0 >= 0.0, (text, box)
        assert box.y0 >= 0.0, (text, box)
        assert box.x1 <= each.bbox.x1, (text, box)
        assert box.y1 <= each.bbox.y1, (text, box)
    for (one, here), (other, there) in combinations(texts, 2):
        wide = min(here.x1, there.x1) - max(here.x0, there.x0)
        high = min(here.y1, there.y1) - max(here.y0, there.y0)
        assert min(wide, high) < 1.5, (one, other)


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
    check(drawn)
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
    assert finding(run, SQUARE, 4.5).endswith('0.5 m over the edge at worst')


@pytest.mark.parametrize(('count', 'theme', 'area'), [(1, 'dark', 0.0), (5, 'light', 0.012)])
def test_probes_of_a_file_and_what_the_tree_drank(sketched, tmp_path, count, theme, area):
    """Days are those of a place six hours ahead of UTC; the file begins at its midnight."""
    at = np.arange(4 * 96)
    values = 20.0 - 1.25 * np.maximum(0.0, 1.0 - np.abs(at % 96 - 56) / 24.0) + 0.0025 * (at % 3)
    parameters = ProbeParameters(solar_offset=6.0)
    series = [read_series(900.0 * at + 64800.0, values, parameters)] * count
    drunk = Litres(1.2, 0.4, 3.6)
    days = [DayOfWater(day, drunk, drunk, 0.5 if day == 1 else 1.0) for day in (1, 2, 3, 4)]
    water = PlaceDays(days, 6.0) if area else None
    names = [f'dT of probe {i}' for i in range(count)]
    draw_probes(names, series, tmp_path / 'oak.png', theme, water)
    check(sketched)
    told = 'Water, with 95 % confidence: 1.20 L (0.40 to 3.60) on a usual day'
    texts = [text for text, _ in sketched[-1][1]]
    assert [text for text in texts if text.startswith('Water')] == [told] * bool(area)
    labels = [text for text in texts if text.startswith('days since')]
    assert labels == ['days since 1970-01-01 18:00 UTC'] * (1 if area else count)
    if area:
        axes = next(a for a in sketched[-1][0].axes if a.get_ylabel() == 'water [L/day]')
        assert [bar.get_x() for bar in axes.patches] == pytest.approx([0.0, 1.0, 2.0, 3.0])


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
    check(drawn)
    texts = [text for text, _ in drawn[-1][1]]
    told = 'Three trees walk 72 metres in 40 minutes, never nearer than 0.8 m to each other'
    assert {told, 'least 0.2 m', 'oak, ash', 'start', 'gives way'} <= set(texts)
    assert (tmp_path / 'trees.png').stat().st_size < 200_000


def test_the_seasons(drawn, tmp_path):
    risen = np.minimum(np.arange(21) / 9.0, 1.0)
    floor = FloorCoverage([risen, risen**0.5], [0.54 * risen, risen])
    draw_season({'square': floor, 'garden': floor, 'rooms': floor}, tmp_path / 'coverage.png')
    check(drawn)
    texts = [text for text, _ in drawn[-1][1]]
    told = 'By memory a tree comes to all of its floor within nine days; straight or not at all, '
    assert f'{told}once to 54 % of it' in texts
    assert texts.count('by memory') == 3
    assert season_finding({'cut': FloorCoverage([[0.0, 0.98]], [[0.0, 0.5]])}).startswith(
        'By memory a tree comes to all of its floor not in time'
    )


def recorded_drive():
    with np.load(RECORDED / 'omni.npz') as held:
        return LocalizationRun(
            *(
                PoseColumns(*(held[f'{name}_{part}'] for part in PoseColumns._fields))
                for name in LocalizationRun._fields
            )
        )


def test_the_drive_of_the_omni_robot(sketched, tmp_path):
    draw_localization(recorded_drive(), tmp_path / 'path.png')
    check(sketched)
    texts = [text for text, _ in sketched[-1][1]]
    events = {'carried away', 'found again after 11 s', 'start', 'end', 'set down', 'found again'}
    assert events <= set(texts)
    assert texts.count('carried away') == 2


def test_when_it_was_carried_and_found_again_by_hand():
    """It stands at 0 m, is set down at 5 m after 3 s, and believes so after 5 s."""
    stamp = np.arange(8.0)
    truth = np.array([[0.0] * 3 + [5.0] * 5, [0.0] * 8, [0.0] * 8])
    believed = np.array([[0.0] * 5 + [5.0] * 3, [0.0] * 8, [0.0] * 8])
    there, told = (PoseColumns(stamp, pose, np.zeros((6, 8))) for pose in (truth, believed))
    run = LocalizationRun(there, told, told, told)
    assert carried(run) == (3.0, 5.0)
    assert localization_finding(run).endswith('it finds itself again after 2 s')
    never = run._replace(pose=told._replace(pose=0.0 * believed))
    assert localization_finding(never).endswith('it did not find itself again')
    assert carried(run._replace(truth=told._replace(pose=0.0 * truth))) is None


def straight_run(planned=None, frames=frozenset({'map'})):
    """1 m/s along x for 10 s, 3 cm left of the way that is shown."""
    time = np.linspace(0.0, 10.0, 201)
    pose = np.array([time, 0.03 + 0.0 * time, 0.0 * time]).T
    driven = Poses('/ground_truth', 'map', time, pose)
    way = np.array([[0.0, 0.0], [20.0, 0.0]])
    return RunBag(planned, driven, {'/path': [way]}, frames)


def test_a_run_beside_the_way_that_was_shown(sketched, tmp_path):
    run = straight_run()
    draw_run(run, None, tmp_path / 'run.png')
    check(sketched)
    texts = [text for text, _ in sketched[-1][1]]
    assert {'10.0 m in 10 s, never more than 3 cm from the way', 'start', 'end'} <= set(texts)
    assert off_the_way(run) == pytest.approx(np.full(201, 0.03))
    assert off_the_way(straight_run(frames=frozenset({'odom'}))) is None


def test_of_a_run_notes_are_named_when_they_were_taken(sketched, tmp_path):
    notes = Note(2_500_000_000, 'rain began'), Note(6 * 10**9, 'x' * 60)
    draw_run(straight_run()._replace(notes=notes), None, tmp_path / 'run.png')
    check(sketched)
    drawn, texts = sketched[-1]
    assert {'rain began', 'x' * 39 + '…'} <= {text for text, _ in texts}
    for axes in drawn.axes[1:]:  # all but the map
        upright = [line.get_xdata()[0] for line in axes.lines if len(set(line.get_xdata())) == 1]
        assert upright == [2.5, 6.0]


def test_a_run_beside_its_ghost(sketched, tmp_path):
    """The Ghost is 4 cm ahead and the robot 3 cm left of it: 5 cm apart."""
    time = np.linspace(0.0, 10.0, 201)
    ghost = Poses('/ghost/pose', 'map', time, np.array([time + 0.04, 0.0 * time, 0.0 * time]).T)
    run = straight_run(ghost)
    draw_run(run, errors_between(ghost, run.driven), tmp_path / 'run.png', theme='dark')
    check(sketched)
    texts = [text for text, _ in sketched[-1][1]]
    assert '10.0 m in 10 s, 5.0 cm from the plan, at most 5.0 cm' in texts
    assert {'along', 'across', 'plan', 'driven'} <= set(texts)


def test_trajectories_beside_their_reference(sketched, tmp_path):
    """One errs by 3 cm, the other by 50 cm."""
    angle = np.linspace(0.0, 3.0, 200)
    places = np.stack([4 * np.sin(angle), 4 * np.cos(angle), 0 * angle], axis=1)
    stamps, turns = np.arange(200) * 10**8, np.tile([0.0, 0.0, 0.0, 1.0], (200, 1))
    told = [
        stamped_poses('/pose', 'map', stamps, places + np.array([0.0, error, 0.0]), turns)
        for error in (0.0, 0.03, 0.5)
    ]
    request = ComparisonRequest(relations=tuple(Relation))
    judged = [(f'run{i} /pose', compare(told[0], told[i], request)) for i in (1, 2)]
    draw_trajectory_errors(judged, tmp_path / 'errors.png', theme='dark')
    check(sketched)
    texts = [text for text, _ in sketched[-1][1]]
    best = 'Best of 2: run1 /pose, translation errs 0.03 m (root mean square)'
    assert {best, 'reference', 'run1 /pose', 'run2 /pose', 'Error of rotation [°]'} <= set(texts)


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
    check(sketched)
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


def test_of_a_run_the_robot_is_drawn_to_scale_or_said_not_to_be(sketched, tmp_path):
    run = straight_run()
    for shapes, word, bodies in (
        (None, 'arrow heads not to scale', 0),
        ([DRIVE] * 5, 'robot to scale', 5),
    ):
        draw_run(run._replace(footprints=shapes), None, tmp_path / 'run.png')
        drawn, texts = sketched[-1]
        assert any(text.endswith(word) for text, _ in texts)
        found = drawn.findobj(lambda artist: artist.get_gid() == robot_drawing.BODY)
        assert len(found) == bodies
    places = sorted(float(body.get_xy()[:, 0].mean()) for body in found)
    assert np.array(places) == pytest.approx([0.0, 2.5, 5.0, 7.5, 10.0], abs=0.1)


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
    check(sketched)
    texts = {text for text, _ in sketched[-1][1]}
    told = 'Stands for an hour, never nearer than 5.8 m to the edge'
    assert {told, 'start and end', 'No goal was set'} <= texts


def test_fields_of_a_bag_with_notes(sketched, tmp_path):
    time = np.linspace(0.0, 100.0, 50)
    many = [FieldLine(f'/turrets/state position[{i}]', time, time + i) for i in range(12)]
    few = [FieldLine(f'/odom twist.linear.{axis}', time, time) for axis in 'xyz']
    notes = [
        (10.0, 'rain began'),
        (10.5, 'somebody opened the gate and left it open'),
        (99.9, 'end'),
    ]
    draw_fields([few, many], tmp_path / 'bag.png', notes)
    check(sketched)
    texts = {text for text, _ in sketched[-1][1]}
    assert {'/odom', 'twist.linear.x', '/turrets/state', 'position[11]', 'rain began'} <= texts
    assert 'somebody opened the gate and left it op…' in texts


def test_a_sequence(sketched, tmp_path):
    found = load_sequence(find_config('sequence_example.yaml'))
    start = Pose(0.0, 0.0, 0.0)
    predicted = predict_sequence(found, start, GhostParameters(), FollowParameters())
    draw_sequence(found.name, start, predicted, tmp_path / 'sequence.png')
    check(sketched)
    texts = [text for text, _ in sketched[-1][1]]
    assert any(t.startswith('Round trip: seven actions, ') for t in texts)
    assert {'2, 3', 'start, 7'} <= set(texts)


def test_a_route(sketched, tmp_path):
    found = load_route(find_config('route_example.yaml'), 1)
    run = predict_route(found, FollowParameters(), Pose(0.0, 0.0, 0.0), 0.05)
    draw_route(found, run, tmp_path / 'route.png')
    check(sketched)
    texts = [text for text, _ in sketched[-1][1]]
    assert {'start', 'end', 'at top speed', 'the end is near'} <= set(texts)


def test_a_plan(sketched, tmp_path):
    limits = GhostParameters()
    ghost = Ghost(Pose(0.0, 0.0, 0.0), limits)
    trajectory = ghost.compute_trajectory(Pose(2.0, 1.0, np.pi / 2), 0.5, 0.4, 0.4)
    draw_plan(trajectory, limits, tmp_path / 'plan.png')
    check(sketched)
    texts = {text for text, _ in sketched[-1][1]}
    assert {'start', 'end', 'left wheel', 'right wheel'} <= texts


def test_labels_and_events_that_would_overlap_are_moved_apart(sketched, tmp_path):
    with figure(tmp_path / 'a.png', [['a']], figsize=(6, 3)) as axes:
        style.title(axes['a'], 'a name longer than any picture is wide ' * 3)
        axes['a'].set(xlim=(0.0, 10.0), ylim=(0.0, 1.0))
        for i in range(5):
            style.line_label(axes['a'], 0.5 + 0.001 * i, f'line {i}', 'k')
            style.event(axes['a'], 4.0 + 0.1 * i, f'event {i}')
    check(sketched)


def test_many_numbers_at_one_place_are_told_in_short():
    places = [(0.1 * i, 0.0) for i in range(8)] + [(5.0, 0.0)]
    numbers = [name.replace('\u2009', '') for _, _, name in style.grouped(places, 0.9)]
    assert numbers == ['1·…·7·8', '9']
    assert [name for *_, name in style.grouped(places, 0.9, 8)] == ['9']


def test_a_line_is_not_joined_over_a_silence():
    time, values = style.broken([0.0, 1.0, 2.0, 30.0, 31.0], [1.0, 2.0, 3.0, 4.0, 5.0])
    assert (
        np.isnan(time).tolist() == np.isnan(values).tolist() == [False] * 3 + [True] + [False] * 2
    )
    assert len(style.broken([0.0, 20.0, 40.0], [1.0, 2.0, 3.0])[0]) == 3  # usual there
    assert len(style.broken([0.0], [1.0])[0]) == 1


def test_a_long_line_is_thinned_and_keeps_its_spikes():
    values = np.zeros(100_000)
    values[77_777], values[5], values[6] = 9.0, -3.0, np.nan
    time, kept = style.thinned(np.arange(100_000.0), values)
    assert len(time) <= style.MOST_POINTS
    assert (kept.max(), kept.min(), time[kept.argmax()]) == (9.0, -3.0, 77_777.0)
