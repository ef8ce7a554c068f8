"""Where a robot was carried during a drive: what is left belongs together."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from agv_motion.odometry import calibration_cuts
from agv_motion.odometry.calibration_cuts import (
    WINDOW,
    _agreeing,
    _consensus,
    _fitted,
    _Path,
    _windows,
    carried_apart,
    groups,
)
from agv_motion.odometry.columns import pose_columns


@pytest.mark.parametrize(
    ('linked', 'found'),
    [
        ('111111', [[10, 11, 12, 20, 21, 22, 23]]),
        ('110111', [[10, 11, 12], [20, 21, 22, 23]]),
        ('101111', [[12, 20, 21, 22, 23]]),  # two tell nothing
        ('000000', []),
        ('011011', [[11, 12, 20], [21, 22, 23]]),
    ],
)
def test_references_are_parted_where_two_neighbours_are_not_linked(linked, found):
    kept = np.array([10, 11, 12, 20, 21, 22, 23])
    parts = groups(kept, np.array([mark == '1' for mark in linked]))
    assert [part.tolist() for part in parts] == found


def test_one_reference_alone_is_no_group():
    assert groups(np.array([4]), np.zeros(0, bool)) == []


def test_what_a_place_may_be_off_grows_with_the_way_and_the_turn():
    """2 m along and 1 rad round a window of nine; 0.02 of 2 m, twice for a whole radian."""
    count = WINDOW + 1
    steps = np.arange(count) * 2
    moved = np.zeros((3, 2 * count))
    moved[0], moved[2] = 2.0 / (2 * (WINDOW - 1)), 1.0 / (2 * (WINDOW - 1))
    drive = SimpleNamespace(
        turned=moved, steering=None, reference_step=steps, reference=np.zeros((3, count)),
        position_noise=0.1, heading_noise=0.03,
    )  # fmt: skip
    model = SimpleNamespace(displacement=lambda *_: moved)
    found = _windows(model, drive, np.zeros(1), 0.02)
    assert found.far == pytest.approx(np.full((2, 1), 5.0 * 0.1 + 0.02 * 2.0 * 2.0))
    assert found.turned == pytest.approx(np.full((2, 1), 5.0 * 0.03 + 0.02 * 2.0))
    assert found.wheels.shape == found.places.shape == found.turns.shape == (2, WINDOW)


class Drive:
    """A base whose wheels say how it moved, a reference every ten steps."""

    def __init__(self, count):
        speeds = np.random.default_rng(3).uniform(-1.0, 1.0, (3, count - 1))
        self.turned = np.repeat(speeds, 10, axis=1) * [[0.05], [0.05], [0.08]]
        self.steering = None
        self.reference_step = np.arange(count) * 10
        self.reference = pose_columns(self.turned)[:, self.reference_step]
        self.position_noise, self.heading_noise = 0.02, 0.01

    def apart(self, longer=1.0):
        """Return the groups where lengths are a share ``longer`` than they are told."""
        model = SimpleNamespace(
            displacement=lambda values, turned, steering: values * turned + steering
        )
        return [part.tolist() for part in carried_apart(model, self, np.full((3, 1), longer))]

    def turn_map(self, angle):
        """See the world from elsewhere."""
        c, s = np.cos(angle), np.sin(angle)
        x, y, heading = self.reference
        self.reference = np.array([c * x - s * y + 2.0, s * x + c * y - 1.0, heading + angle])


ALL = list(range(30))


@pytest.mark.parametrize('heading', [True, False])
@pytest.mark.parametrize('map_turned', [0.0, 2.0])
def test_a_drive_is_cut_where_somebody_carried_the_robot(heading, map_turned):
    """By 4 m after reference 14; reference 5 is an outlier, and told by none of the others."""
    drive = Drive(30)
    assert drive.apart() == [ALL]
    drive.reference[0, 15:] += 4.0
    drive.reference[:2, 5] += 3.0
    drive.turn_map(map_turned)
    if not heading:
        drive.reference[2] = np.nan
    assert drive.apart() == [[*ALL[:5], *ALL[6:15]], ALL[15:]]


def test_a_heading_alone_tells_that_a_robot_was_turned():
    """By half a radian, where it stood: its places would fit for a while."""
    drive = Drive(30)
    drive.turned[:2] = 0.0
    drive.reference[:2] = 0.0
    drive.reference[2, 15:] += 0.5
    assert drive.apart() == [ALL[:15], ALL[15:]]


def test_where_the_places_are_of_no_use_the_drive_stays_whole():
    drive = Drive(30)
    drive.reference[:2] = np.random.default_rng(1).uniform(-50.0, 50.0, (2, 30))
    assert drive.apart() == [ALL]


def test_the_steering_is_a_part_of_what_the_wheels_say():
    drive = Drive(30)
    drive.steering = 0.5 * drive.turned
    drive.turned = drive.turned - drive.steering
    assert drive.apart() == [ALL]


@pytest.mark.parametrize(('count', 'kept'), [(8, 8), (9, 8), (10, 9)])
def test_of_fewer_than_nine_references_none_is_asked(count, kept):
    drive = Drive(count)
    drive.reference[0, -1] += 4.0
    assert drive.apart() == [ALL[:kept]]


def test_the_tightest_doubt_is_taken_that_explains_four_fifths(monkeypatch):
    """Of ten references eight are enough, and seven are not."""
    asked = []

    def apart(_model, _recording, _values, share):
        asked.append(share)
        return [np.arange(5), np.arange(3 if share >= enough else 2)]

    monkeypatch.setattr(calibration_cuts, '_apart', apart)
    enough = 0.05
    assert Drive(10).apart() == [[0, 1, 2, 3, 4], [0, 1, 2]]
    assert asked == [0.01, 0.02, 0.05]
    enough = 1.0
    assert Drive(10).apart() == [ALL[:10]]
    assert asked[3:] == [0.01, 0.02, 0.05, 0.1]


def straight(off, turns=None, far=0.1):
    """Return one window: wheels along x, places beside it by ``off`` [m]."""
    wheels = np.arange(9.0)[None] + 0j
    turns = np.full((1, 9), np.nan) if turns is None else np.array([turns], dtype=float)
    return _Path(wheels, wheels + 1j * np.array([off]), turns, np.array([[far]]), np.array([[0.2]]))


@pytest.mark.parametrize(('spoilt', 'kept'), [(3, 6), (4, 0)])
def test_six_of_nine_have_to_agree(spoilt, kept):
    off = [7.0, -5.0, 3.0, -9.0][:spoilt] + [0.0] * (9 - spoilt)
    found = _consensus(straight(off))
    assert found[0].tolist() == [False] * spoilt + [bool(kept)] * (9 - spoilt)


def test_all_that_agree_have_a_say_in_where_the_path_lies():
    """One places it well for eight; the best fit of those is right for the ninth too."""
    found = _consensus(straight([0.09, -0.09, 0.03, 0.0, 0.0, 0.0, 0.0, -0.05, 0.1]))
    assert found.all()


def test_the_best_placing_is_hand_calculated():
    """A quarter turn, and 2 m along x: what is not chosen has no say."""
    wheels = np.array([[0.0, 1.0, 1.0 + 1.0j, 5.0], [1.0, 2.0, 3.0, 4.0]])
    places = 1j * wheels + 2.0
    places[0, 3] = 100.0
    places[1, 1:] = 50.0
    path = _Path(wheels, places, np.zeros((2, 4)), np.ones((2, 1)), np.ones((2, 1)))
    chosen = np.array([[True, True, True, False], [True, False, False, False]])
    rotation, translation = _fitted(path, chosen)
    assert rotation[0, 0] == pytest.approx(1j)
    assert translation[0, 0] == pytest.approx(2.0)
    assert rotation[1, 0] * 1.0 + translation[1, 0] == pytest.approx(2.0 + 1j)


def test_what_a_placing_explains_lies_within_both_bounds():
    """0.1 m and 0.2 rad, about a quarter turn; a heading that is not known is no matter."""
    off = [0.0, 0.099, -0.099, 0.101, -0.101, 0.0, 0.0, 0.0, 0.0]
    turns = np.pi / 2 + np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.199, -0.199, 0.201, -0.201])
    path = straight(off, turns)
    path = path._replace(places=1j * path.places + 3.0)
    quarter, shift = np.array([[1j]]), np.array([[3.0 + 0j]])
    agreeing = [True, True, True, False, False, True, True, False, False]
    assert _agreeing(path, quarter, shift)[0].tolist() == agreeing
    unknown = path._replace(turns=np.full((1, 9), np.nan))
    assert _agreeing(unknown, quarter, shift)[0].tolist() == [*agreeing[:7], True, True]
