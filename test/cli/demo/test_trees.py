"""`agv demo trees`: several trees in one zone, and figures that are what their bag says."""

from __future__ import annotations

import re
import signal

import pytest

pytest.importorskip('rclpy')

from agv_motion.bag.reader import BagReader
from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.report.walks import gaps, read_walks


def test_two_walk_in_a_terminal_of_any_size_and_leave_a_bag_and_a_figure(terminal, tmp_path):
    screen = terminal(
        'demo', 'trees', '--count', 2, '--minutes', 0.5, '--time-factor', 15,
        '--no-page', '--output', tmp_path,
    )  # fmt: skip
    for columns, rows in ((80, 24), (200, 50)):
        screen.resize(columns, rows)
        picture = '\n'.join(screen.picture())
        for word in ('pace', 'oak', 'ash', 'sap', 'walking'):
            assert word in picture
    status, out = screen.end()
    assert status == 0, out
    assert set(screen.frames()) == {(80, 24), (200, 50)}
    assert (tmp_path / 'trees.png').stat().st_size > 10_000
    with BagReader(tmp_path / 'bag') as bag:
        walks = read_walks(bag, ['oak', 'ash'])
        assert bag.counts['/reservations'] > 25
    assert all(walk.distance() > 0.03 for walk in walks)
    assert all(walk.goals for walk in walks)
    assert re.search(r'oak and ash came nearest: \d+\.\d\d m from rim to rim', out)
    _, between = gaps(walks, TrafficParameters().body)
    assert between['oak and ash'].min() > TrafficParameters().margin


def test_ctrl_c_at_the_very_beginning_is_no_error(alone, tmp_path, wait_until):
    process = alone.start('demo', 'trees', '--count', 2, '--no-page', '--output', tmp_path)
    wait_until(lambda: list(tmp_path.glob('bag/*.mcap')))
    process.send_signal(signal.SIGINT)
    out, errors = process.communicate(timeout=180.0)
    assert process.returncode == 0, errors
    assert 'Bag: ' in out


def test_a_tree_alone_and_too_many_are_refused(alone):
    for count in (1, 6):
        status, _, errors = alone('demo', 'trees', '--count', count)
        assert status == 2
        assert '--count' in errors


def test_trees_that_do_not_fit_are_refused(alone, tmp_path):
    status, _, errors = alone(
        'demo',
        'trees',
        '--count',
        5,
        '--zone',
        'zone_indoor.yaml',
        '--no-page',
        '--output',
        tmp_path,
    )
    assert status == 1
    assert '5 trees do not fit into this zone' in errors
