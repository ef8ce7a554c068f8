"""`agv demo trees`: several trees in one zone, and figures that are what their bag says."""

from __future__ import annotations

import re
import signal

import numpy as np
import pytest

pytest.importorskip('rclpy')

from agv_motion.bag.reader import BagReader
from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.report.walks import RecordedWalk, doing_of, gaps, nearest, read_walks

TRAFFIC = TrafficParameters(body=1.0, margin=0.2)


def test_a_short_walk_of_two_leaves_a_bag_and_a_figure(alone, tmp_path):
    status, out, errors = alone(
        'demo', 'trees', '--count', 2, '--minutes', 3, '--time-factor', 15, '--output', tmp_path,
        timeout=120.0,
    )  # fmt: skip
    assert status == 0, errors
    assert (tmp_path / 'trees.png').stat().st_size > 10_000
    with BagReader(tmp_path / 'bag') as bag:
        walks = read_walks(bag, ['oak', 'ash'])
        assert bag.counts['/reservations'] > 100
    assert all(walk.distance() > 0.5 for walk in walks)
    assert all(walk.goals for walk in walks)
    assert re.search(r'oak and ash came nearest: \d+\.\d\d m from rim to rim', out)
    _, between = gaps(walks, TrafficParameters().body)
    assert between['oak and ash'].min() > TrafficParameters().margin


def test_ctrl_c_at_the_very_beginning_is_no_error(alone, tmp_path, wait_until):
    process = alone.start('demo', 'trees', '--output', tmp_path)
    wait_until(lambda: list(tmp_path.glob('bag/*.mcap')))
    process.send_signal(signal.SIGINT)
    out, errors = process.communicate(timeout=120.0)
    assert process.returncode == 0, errors
    assert 'Bag: ' in out


def test_a_tree_alone_and_too_many_are_refused(alone):
    for count in (1, 6):
        status, _, errors = alone('demo', 'trees', '--count', count)
        assert status == 2
        assert '--count' in errors


def test_trees_that_do_not_fit_are_refused(alone, tmp_path):
    status, _, errors = alone(
        'demo', 'trees', '--count', 5, '--zone', 'zone_indoor.yaml', '--output', tmp_path
    )
    assert status == 1
    assert '5 trees do not fit into this zone' in errors


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
    oak = RecordedWalk('oak', time, np.array([[0.0, 10.0], [0.0, 0.0]]), [], [(0.0, 'walks')])
    doings = [(0.0, 'rests'), (2.5, 'walks'), (7.5, 'waits')]
    ash = RecordedWalk('ash', time, np.array([[0.0, 10.0], [5.0, 2.5]]), [(1.0, 2.0, 3.0)], doings)
    times, between = gaps([oak, ash], 1.0)
    assert times[:3] == pytest.approx([0.0, 0.5, 1.0])
    assert between['oak and ash'] == pytest.approx(5.0 - 0.25 * times - 2.0)
    assert 'oak and ash came nearest: 0.62 m' in nearest([oak, ash], TRAFFIC)
    assert ash.spans() == [(0.0, 2.5, 'rests'), (2.5, 5.0, 'walks'), (7.5, 2.5, 'waits')]
    assert (ash.share('walks'), ash.share('gives way')) == (0.5, 0.0)
    assert oak.distance() == 10.0
