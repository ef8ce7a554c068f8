"""Absolute and relative errors: hand calculations, and number for number those of evo."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.report.stamped_poses import associate, stamped_poses
from agv_motion.report.trajectory_alignment import Alignment, align
from agv_motion.report.trajectory_errors import (
    ComparisonRequest,
    Delta,
    DeltaUnit,
    Relation,
    absolute_errors,
    compare,
    pairs,
    relative_errors,
    statistics,
)

BEGIN = 1_400_000_000 * 10**9
TENTH = 10**8


def planar(xs, ys, headings, frame='map'):
    """Return poses in the plane, ten a second."""
    xs, ys, half = (np.asarray(values, float) for values in (xs, ys, np.divide(headings, 2)))
    stamps = BEGIN + TENTH * np.arange(len(xs))
    turns = np.stack([0 * half, 0 * half, np.sin(half), np.cos(half)], axis=1)
    return stamped_poses('/odom', frame, stamps, np.stack([xs, ys, 0 * xs], axis=1), turns)


def wandering(count, seed):
    """Return poses all over space, at uneven times."""
    random = np.random.default_rng(seed)
    stamps = BEGIN + np.cumsum(random.integers(TENTH // 2, 2 * TENTH, count))
    places = np.cumsum(random.normal(0.0, 0.1, (count, 3)), axis=0)
    turns = np.cumsum(random.normal(0.0, 0.1, (count, 4)), axis=0) + np.array([0, 0, 0, 1])
    turns /= np.linalg.norm(turns, axis=1)[:, None]
    return stamped_poses('/odom', 'map', stamps, places, turns)


def test_absolute_errors_by_hand():
    """1 m ahead, 3 and 4 cm aside, a right angle turned; the whole: |R - 1|^2 = 4 (1 - cos)."""
    truth = planar([0, 1, 2], [0, 0, 0], [0, 0, 0])
    told = planar([1, 1.03, 2], [0, 0.04, 0], [0, 0, -np.pi / 2])
    assert absolute_errors(truth, told, Relation.TRANSLATION) == pytest.approx([1, 0.05, 0])
    assert absolute_errors(truth, told, Relation.ROTATION) == pytest.approx([0, 0, 90])
    assert absolute_errors(truth, told, Relation.FULL) == pytest.approx([1, 0.05, 2])


def test_relative_errors_by_hand():
    """In another frame, turned by a right angle, the same way errs by nothing; then 10 cm less."""
    truth = planar([0, 1, 2, 3], [0] * 4, [0] * 4)
    told = planar([5] * 4, [0, 1, 2, 2.9], [np.pi / 2] * 3 + [np.pi / 2 + 0.1])
    found = pairs(told, Delta())
    assert found.tolist() == [[0, 1], [1, 2], [2, 3]]
    errors = relative_errors(truth, told, found, Relation.TRANSLATION)
    assert errors == pytest.approx([0, 0, 0.1])
    errors = relative_errors(truth, told, found, Relation.ROTATION)
    assert errors == pytest.approx([0, 0, np.degrees(0.1)], abs=1e-9)


def test_statistics_by_hand():
    assert statistics(np.array([1.0, 2.0, 6.0])) == pytest.approx(
        ((41 / 3) ** 0.5, 3, 2, (14 / 3) ** 0.5, 1, 6, 41)
    )


@pytest.mark.parametrize(
    ('delta', 'expected'),
    [
        (Delta(2), [[0, 2], [2, 4]]),
        (Delta(3, all_pairs=True), [[0, 3], [1, 4], [2, 5]]),
        (Delta(2, DeltaUnit.METRES), [[0, 2], [2, 5]]),
        (Delta(2, DeltaUnit.METRES, all_pairs=True), [[0, 2], [1, 4], [2, 5], [3, 5]]),
        (Delta(2.4, DeltaUnit.METRES, all_pairs=True, tolerance=0.1), []),
        (Delta(0.2, DeltaUnit.SECONDS), [[0, 2], [2, 4]]),
        (Delta(0.4, DeltaUnit.SECONDS, all_pairs=True), [[0, 4], [1, 5]]),
    ],
)
def test_pairs_by_hand(delta, expected):
    """Steps of 1 m, but for a rest from the third pose to the fourth."""
    told = planar([0, 1, 2, 2, 3, 4], [0] * 6, [0] * 6)
    if expected:
        assert pairs(told, delta).tolist() == expected
    else:
        with pytest.raises(ConfigurationError, match=r'no poses are 2\.4 metres .* cover 4 metres'):
            pairs(told, delta)


@pytest.mark.parametrize('size', [0, -1, float('nan'), float('inf'), 1.5])
def test_a_distance_that_is_none_is_refused(size):
    with pytest.raises(ConfigurationError, match=f'--delta {size}'):
        pairs(planar([0, 1, 2], [0] * 3, [0] * 3), Delta(size))
    with pytest.raises(ConfigurationError, match='--tolerance nan'):
        pairs(planar([0, 1, 2], [0] * 3, [0] * 3), Delta(tolerance=float('nan')))


def test_other_frames_need_an_alignment_or_the_relative_error():
    truth = planar([0, 1, 2], [0, 1, 0], [0] * 3, frame='/map')
    told = planar([0, 1, 2], [0, 1, 0], [0] * 3, frame='odom')
    with pytest.raises(ConfigurationError, match=r"in frame '/map', /odom in 'odom': .*--align"):
        compare(truth, told, ComparisonRequest())
    for request in (ComparisonRequest(alignment=Alignment.SE2), ComparisonRequest(delta=Delta())):
        found = compare(truth, told, request)
        assert found.errors[Relation.TRANSLATION] == pytest.approx(0.0, abs=1e-12)
    compare(truth, told._replace(frame='map'), ComparisonRequest())


def of_evo(poses):
    trajectory = pytest.importorskip('evo.core.trajectory')
    matrices = np.tile(np.eye(4), (len(poses.stamp), 1, 1))
    matrices[:, :3, :3], matrices[:, :3, 3] = poses.rotation, poses.position
    stamps = (poses.stamp - BEGIN) * 1e-9
    return trajectory.PoseTrajectory3D(poses_se3=list(matrices), timestamps=stamps)


def check(found, metric):
    """Compare the errors and their statistics."""
    assert found == pytest.approx(metric.error, rel=1e-9, abs=1e-9)
    expected = metric.get_all_statistics()
    for name, value in statistics(found)._asdict().items():
        assert value == pytest.approx(expected[name], rel=1e-9, abs=1e-9), name


@pytest.mark.parametrize(
    ('alignment', 'scaled'),
    [
        (Alignment.NONE, False), (Alignment.ORIGIN, False),
        (Alignment.SE3, False), (Alignment.SE3, True),
    ],
)  # fmt: skip
def test_everything_is_equal_to_evo(alignment, scaled):
    """Association, alignment, pairs, errors and statistics, of uneven runs in space."""
    metrics, sync = pytest.importorskip('evo.core.metrics'), pytest.importorskip('evo.core.sync')
    kinds = {
        Relation.TRANSLATION: metrics.PoseRelation.translation_part,
        Relation.ROTATION: metrics.PoseRelation.rotation_angle_deg,
        Relation.FULL: metrics.PoseRelation.full_transformation,
    }
    units = {DeltaUnit.FRAMES: metrics.Unit.frames, DeltaUnit.METRES: metrics.Unit.meters}
    for counts in ((150, 90), (80, 160)):
        truth, told = wandering(counts[0], 1), wandering(counts[1], 2)
        first, second = sync.associate_trajectories(
            of_evo(truth), of_evo(told), max_diff=0.03, offset_2=0.02
        )
        if alignment is Alignment.ORIGIN:
            second.align_origin(first)
        elif alignment is not Alignment.NONE:
            second.align(first, correct_scale=scaled)
        deltas = [Delta(s, u, a) for s, u, a in product((1, 3), units, (False, True))]
        for delta in (None, *deltas):
            found = compare(
                truth,
                told,
                ComparisonRequest(0.03, 0.02, alignment, scaled, delta, tuple(Relation)),
            )
            for relation, kind in kinds.items():
                if delta is None:
                    metric = metrics.APE(kind)
                else:
                    metric = metrics.RPE(
                        kind, delta.size, units[delta.unit], delta.tolerance, delta.all_pairs
                    )
                metric.process_data((first, second))
                check(found.errors[relation], metric)


@pytest.mark.parametrize('scaled', [False, True])
def test_the_alignment_in_the_plane_is_equal_to_evo(scaled):
    geometry = pytest.importorskip('evo.core.geometry')
    truth, told = wandering(50, 3), wandering(50, 4)
    _, moved = align(truth, told, Alignment.SE2, scaled=scaled)
    turn, shift, scale = geometry.umeyama_alignment(
        told.position[:, :2].T, truth.position[:, :2].T, scaled
    )
    assert moved.rotation[:2, :2] == pytest.approx(turn, abs=1e-12)
    assert moved.translation == pytest.approx([*shift, 0.0], abs=1e-12)
    assert moved.scale == pytest.approx(scale, abs=1e-12)


@pytest.mark.parametrize('step', [0.1, 0.25])
def test_pairs_of_even_steps_are_those_of_evo(step):
    """Where sums of rounded steps decide."""
    metrics = pytest.importorskip('evo.core.metrics')
    told = planar(step * np.arange(60), [0] * 60, [0] * 60)
    poses = of_evo(told).poses_se3
    for size, every in product((0.3, 1.0, 0.35), (False, True)):
        expected = metrics.id_pairs_from_delta(
            poses, size, metrics.Unit.meters, rel_tol=0.5, all_pairs=every
        )
        found = pairs(told, Delta(size, DeltaUnit.METRES, every, 0.5))
        assert found.tolist() == [list(map(int, pair)) for pair in expected]


def test_a_long_run_takes_no_time_in_its_square():
    """100000 poses, all pairs: what a search of each in all would make 10^10 steps."""
    told = planar(0.01 * np.arange(100_000), np.zeros(100_000), np.zeros(100_000))
    found = pairs(told, Delta(5, DeltaUnit.METRES, all_pairs=True))
    assert set(np.diff(found, axis=1).ravel()[:99_500]) == {500}
    assert associate(told, told)[0].stamp.tolist() == told.stamp.tolist()
