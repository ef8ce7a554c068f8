"""Simulated UWB: noise as told, and everything that befalls it, from a seed."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.planar import Pose
from agv_motion.simulation.uwb import Uwb, UwbParameters

PLACE = Pose(3.0, 4.0, 1.0)


def fixes(count=2000, seed=1, **parameters):
    """Return all fixes of a robot that stands still, one a second."""
    uwb = Uwb(UwbParameters(**parameters), seed)
    for i in range(count):
        uwb.measure(float(i), PLACE)
    return uwb.arrivals(1e9)


def errors(found):
    return np.array([(fix.x - PLACE.x, fix.y - PLACE.y) for fix in found])


def test_white_noise_is_what_its_covariance_says():
    found = fixes(position_noise=0.2, heading_noise=0.1)
    assert errors(found).std(axis=0) == pytest.approx([0.2, 0.2], rel=0.06)
    assert found[0].covariance[:4] == pytest.approx((0.04, 0.0, 0.0, 0.04))
    assert np.std([fix.heading for fix in found]) == pytest.approx(0.1, rel=0.06)


def test_one_tag_tells_no_heading():
    assert fixes(count=1)[0].heading is None


def test_a_seed_belongs_to_its_noise():
    assert fixes(10, seed=1) == fixes(10, seed=1) != fixes(10, seed=2)


def test_outliers_have_their_share():
    far = np.hypot(*errors(fixes(outlier_share=0.2, outlier_reach=50.0)).T) > 1.0
    assert far.mean() == pytest.approx(0.2, abs=0.03)


def test_latency_is_bounded_and_swaps_the_order():
    uwb, order = Uwb(UwbParameters(latency=3.0), 1), []
    for i in range(500):
        uwb.measure(float(i), PLACE)
        arrived = [fix.stamp for fix in uwb.arrivals(float(i))]
        assert all(i - 3.0 <= stamp <= i for stamp in arrived)
        order += arrived
    assert order != sorted(order)
    assert len(set(order)) == len(order) >= 497


def test_multipath_is_steady_for_a_while():
    found = errors(fixes(position_noise=0.001, multipath_interval=50.0, multipath_duration=10.0))
    shifted = np.hypot(*found.T) > 0.05
    assert 0.05 < shifted.mean() < 0.35
    steps = np.abs(np.diff(found, axis=0)).max(axis=1)
    assert np.median(steps[shifted[:-1] & shifted[1:]]) < 0.005


def test_drop_outs_last_as_long_as_told():
    stamps = np.array([fix.stamp for fix in fixes(dropout_interval=200.0, dropout_duration=60.0)])
    gaps = np.diff(stamps)
    assert set(gaps) == {1.0, 61.0}


def test_its_covariance_tells_position_and_heading():
    covariance = UwbParameters(position_noise=0.2, heading_noise=0.1).covariance()
    assert covariance == pytest.approx((0.04, 0.0, 0.0, 0.04, 0.0, 0.01))


def test_nothing_befalls_it_before_its_beginning():
    """The first drop-out comes some 5 s after it, which is not so for who begins at 0."""
    uwb = Uwb(UwbParameters(dropout_interval=5.0, dropout_duration=1.0), 1, begin=1000.0)
    for i in range(100):
        uwb.measure(1000.0 + i, PLACE)
    found = [fix.stamp for fix in uwb.arrivals(1e9)]
    assert found[0] == 1000.0
    assert 70 < len(found) < 90


def test_with_everything_that_befalls_it_a_seed_gives_what_it_gave():
    found = fixes(
        60, position_noise=0.1, heading_noise=0.1, latency=2.0, outlier_share=0.1,
        outlier_reach=9.0, multipath_interval=9.0, multipath_duration=3.0, dropout_interval=20.0,
        dropout_duration=4.0,
    )  # fmt: skip
    assert len(found) == 56
    sums = (sum(values) for values in zip(*((f.x, f.y, f.heading) for f in found), strict=True))
    assert tuple(sums) == pytest.approx((154.138865, 267.069658, 56.072554), abs=1e-6)


def test_impossible_parameters_are_refused():
    with pytest.raises(ConfigurationError, match=r'outlier_share = 1\.5'):
        UwbParameters(outlier_share=1.5)


def test_multipath_shifts_to_any_side_and_no_farther_than_told():
    given = {'multipath_interval': 5.0, 'multipath_duration': 5.0, 'multipath_reach': 2.0}
    found = errors(fixes(position_noise=0.001, **given))
    assert 1.8 < np.hypot(*found.T).max() < 2.01
    assert (abs(found) > 1.5).any(axis=0).all()


def test_drop_outs_may_be_more_than_one_a_second():
    assert len(fixes(100, dropout_interval=0.5, dropout_duration=10.0)) < 30
    assert len(fixes(100)) == 100
