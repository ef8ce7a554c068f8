"""The Kalman update in plain numbers says what matrices say."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.odometry import kalman
from agv_motion.odometry.covariance import Covariance
from agv_motion.odometry.kalman import _sound, _whitened, correct

NUMBER = st.floats(-2.0, 2.0)


def matrix(covariance):
    xx, xy, xt, yy, yt, tt = covariance
    return np.array([[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]])


@st.composite
def covariances(draw):
    root = np.array(draw(st.lists(NUMBER, min_size=9, max_size=9))).reshape(3, 3)
    return Covariance(*(root @ root.T + 0.1 * np.eye(3))[np.triu_indices(3)])


@given(covariances(), covariances(), st.tuples(NUMBER, NUMBER, NUMBER), st.sampled_from([2, 3]))
def test_the_update_is_that_of_the_textbook(prior, noise, missed, count):
    p, h = matrix(prior), np.eye(3)[:count]
    innovation = np.array(missed[:count])
    s = h @ p @ h.T + matrix(noise)[:count, :count]
    gain = p @ h.T @ np.linalg.inv(s)
    update = correct(prior, missed, noise, count)
    np.testing.assert_allclose(update.correction, gain @ innovation, atol=1e-9)
    expected = (np.eye(3) - gain @ h) @ p
    np.testing.assert_allclose(matrix(update.covariance), expected, atol=1e-9)
    distance = innovation @ np.linalg.inv(s) @ innovation
    assert update.distance == pytest.approx(distance, rel=1e-8, abs=1e-12)


@given(covariances(), covariances(), st.sampled_from([2, 3]))
def test_what_no_rounding_makes_negative_is_that_of_the_textbook_too(prior, noise, count):
    p, h = matrix(prior), np.eye(3)[:count]
    s = h @ p @ h.T + matrix(noise)[:count, :count]
    expected = (np.eye(3) - p @ h.T @ np.linalg.inv(s) @ h) @ p
    found = _sound(prior, _whitened((0.0, 0.0, 0.0), noise, count))
    np.testing.assert_allclose(matrix(found), expected, atol=1e-9)


@pytest.mark.parametrize(('surer', 'steep'), [(0.9e6, False), (1.5e6, True)])
@pytest.mark.parametrize('which', [0, 1, 2])
def test_it_is_asked_where_a_measurement_is_a_million_times_surer(surer, steep, which, monkeypatch):
    asked = []
    monkeypatch.setattr(kalman, '_sound', lambda *given: asked.append(1) or _sound(*given))
    variances = [surer if i == which else 1.0 for i in range(3)]
    prior = Covariance(variances[0], 0.0, 0.0, variances[1], 0.0, variances[2])
    one = Covariance(1.0, 0.0, 0.0, 1.0, 0.0, 1.0)
    update = correct(prior, (0.0, 0.0, 0.0), one, 3)
    assert asked == [1] * steep
    left = [variance / (variance + 1.0) for variance in variances]
    assert update.covariance == pytest.approx((left[0], 0.0, 0.0, left[1], 0.0, left[2]), abs=1e-9)


def test_halfway_between_equals_by_hand():
    """Hand calculation: both equally sure of x: half the way, half the variance."""
    one = Covariance(1.0, 0.0, 0.0, 1.0, 0.0, 1.0)
    update = correct(one, (2.0, 0.0, 0.0), one, 2)
    assert update.correction == pytest.approx((1.0, 0.0, 0.0), abs=1e-15)
    assert update.covariance == pytest.approx((0.5, 0.0, 0.0, 0.5, 0.0, 1.0), abs=1e-15)
    assert update.distance == pytest.approx(2.0, abs=1e-15)
