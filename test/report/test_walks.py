"""What several trees did, and how near they came, by hand."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.report.walks import RecordedWalk, doing_of, gaps, nearest

TRAFFIC = TrafficParameters(body=1.0, margin=0.2)


@pytest.mark.parametrize(
    ('state', 'doing'),
    [
        ('walking to never visited: (8.6, 7.6)', 'walks'),
        ('walking to never visited: (8.6, 7.6): waits for ash', 'waits'),
        ('walking to (1.0, 2.0), asked for: waits for the answer of ash', 'waits'),
        ('resting: the sap stands: gives way', 'gives way'),
        ('resting: the sap stands', 'rests'),
        ('stopped: no goal', 'rests'),
        ('turning on the spot at the goal; not turning: delicate floor', 'walks'),
    ],
)
def test_what_a_tree_does_is_told_by_its_state(state, doing):
    assert doing_of(state) == doing


def test_gaps_and_shares_by_hand():
    """Two trees of 1 m on parallel ways, 5 m apart at first and 2.5 m after 10 s."""
    time = np.array([0.0, 10.0])
    oak = RecordedWalk('oak', time, np.array([[0.0, 10.0], [0.0, 0.0]]), [], [(0.0, 'walks')],
                       np.zeros(2))  # fmt: skip
    doings = [(0.0, 'rests'), (2.5, 'walks'), (7.5, 'waits')]
    ash = RecordedWalk('ash', time, np.array([[0.0, 10.0], [5.0, 2.5]]), [(1.0, 2.0, 3.0)], doings,
                       np.zeros(2))  # fmt: skip
    times, between = gaps([oak, ash], 1.0)
    assert times[:3] == pytest.approx([0.0, 0.5, 1.0])
    assert between['oak and ash'] == pytest.approx(5.0 - 0.25 * times - 2.0)
    assert 'oak and ash came nearest: 0.62 m' in nearest([oak, ash], TRAFFIC)
    assert ash.spans() == [(0.0, 2.5, 'rests'), (2.5, 5.0, 'walks'), (7.5, 2.5, 'waits')]
    assert (ash.share('walks'), ash.share('gives way')) == (0.5, 0.0)
    assert oak.distance() == 10.0


def test_walks_that_were_ended_before_they_met_in_time_have_a_gap_all_the_same():
    oak, ash = (
        RecordedWalk(name, np.array([at]), np.array([[x], [0.0]]), [], [(at, 'rests')], np.zeros(1))
        for name, at, x in (('oak', 0.1, 0.0), ('ash', 0.2, 5.0))
    )
    times, between = gaps([oak, ash], 1.0)
    assert times == pytest.approx([0.2])
    assert between['oak and ash'] == pytest.approx([3.0])
    assert 'oak and ash came nearest: 3.00 m' in nearest([oak, ash], TRAFFIC)
