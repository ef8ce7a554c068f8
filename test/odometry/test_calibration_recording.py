"""A recorded drive: what fits together, and its stretches."""

from __future__ import annotations

from math import inf, nan

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.odometry.calibration_recording import LONGEST, CalibrationDrive


def drive(steps=(0, 4, 10), **changes):
    """Return a drive of ten steps of two wheels, each number of it another."""
    steps = np.array(steps)
    given = {
        'turned': np.arange(20.0).reshape(2, 10),
        'reference_step': steps,
        'reference': 100.0 + np.arange(3.0 * len(steps)).reshape(3, -1),
        'position_noise': 0.5,
        'heading_noise': 0.25,
    }
    return CalibrationDrive(**(given | changes))


@pytest.mark.parametrize('steps', [(0, 10), (0, 1), (9, 10), (0, 1, 2, 10)])
def test_references_may_stand_at_either_end(steps):
    assert drive(steps).reference_step.tolist() == list(steps)


@pytest.mark.parametrize('steps', [(0,), (), (-1, 10), (0, 11), (0, 4, 4), (5, 4)])
def test_references_rise_within_the_drive(steps):
    match = r'^reference steps must rise within 0 to 10, at least 2 of them$'
    with pytest.raises(SignalError, match=match):
        drive(np.array(steps, dtype=int))


@pytest.mark.parametrize(
    ('changes', 'match'),
    [
        ({'turned': np.zeros(10)}, r'^turned \(10,\), steps \(3,\), reference \(3, 3\): give'),
        ({'reference': np.zeros((2, 3))}, r'reference \(2, 3\): give \(n, m\), \(k,\) and'),
        ({'steering': np.zeros((2, 9))}, r'steering has shape \(2, 9\), wheels \(2, 10\)'),
        ({'steering': np.full((2, 10), nan)}, 'must be finite: drop the bad rows'),
        ({'turned': np.full((2, 10), inf)}, 'must be finite: drop the bad rows'),
        ({'reference': np.array([[0, 0, 0], [0, nan, 0], [0, 0, 0]])}, 'must be finite'),
        ({'reference': np.array([[0, 0, 0], [0, 0, 0], [0, inf, 0]])}, 'must be finite'),
    ],
)
def test_what_does_not_fit_together_is_refused(changes, match):
    with pytest.raises(SignalError, match=match):
        drive(**changes)


def test_a_heading_is_known_to_a_fiftieth_of_a_radian_or_not_at_all():
    assert (
        CalibrationDrive(np.zeros((2, 1)), np.arange(2), np.zeros((3, 2)), 0.1).heading_noise
        == 0.02
    )
    assert drive(reference=np.array([[0, 0, 0], [0, 0, 0], [0, nan, 0]])).steering is None


@pytest.mark.parametrize('noise', [0.0, -1.0, nan, inf])
@pytest.mark.parametrize('name', ['position_noise', 'heading_noise'])
def test_a_noise_is_finite_and_above_0(name, noise):
    with pytest.raises(ConfigurationError, match=f'^{name} = {noise}: must be finite and above 0'):
        drive(**{name: noise})


@pytest.mark.parametrize('steered', [False, True])
def test_a_part_has_the_steps_between_its_references(steered):
    steering = -np.arange(20.0).reshape(2, 10) if steered else None
    part = drive((1, 3, 4, 8), steering=steering).part(np.array([1, 3]))
    assert part.turned.tolist() == [[3.0, 4.0, 5.0, 6.0, 7.0], [13.0, 14.0, 15.0, 16.0, 17.0]]
    assert part.reference_step.tolist() == [0, 5]
    assert part.reference.tolist() == [[101.0, 103.0], [105.0, 107.0], [109.0, 111.0]]
    assert (part.position_noise, part.heading_noise) == (0.5, 0.25)
    assert (part.steering is not None) == steered
    if steered:
        assert part.steering.tolist() == (-part.turned).tolist()


@pytest.mark.parametrize(
    ('references', 'counts'),
    [
        (2, [2]), (LONGEST // 2, [LONGEST // 2]), (LONGEST + LONGEST // 2 - 1, [89]),
        (2 * LONGEST, [LONGEST] * 2), (3 * LONGEST - 10, [57, 56, 57]),
    ],
)  # fmt: skip
def test_a_stretch_has_about_sixty_references_of_its_own(references, counts):
    """170 references in three: up to 56.67, rounded, and up to 113.33."""
    assert LONGEST == 60
    turned = np.zeros((2, references))
    steps, reference = np.arange(references), np.zeros((3, references))
    parts = CalibrationDrive(turned, steps, reference, 0.1).stretches()
    assert [len(part.reference_step) for part in parts] == counts
