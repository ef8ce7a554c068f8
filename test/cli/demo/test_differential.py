"""`agv demo differential`: the robot performs a sequence and ends where it should."""

from __future__ import annotations

import re

import pytest

pytest.importorskip('rclpy')

SEQUENCE = """
actions:
  - go_to: {x: 0.6, y: 0.2, heading: 0}
  - rotate: {by: 45}
"""


def test_a_short_sequence_leaves_a_bag_and_a_figure(terminal, tmp_path):
    file = tmp_path / 'short.yaml'
    file.write_text(SEQUENCE, encoding='utf-8')
    screen = terminal(
        'demo', 'differential', '--sequence', file, '--time-factor', 4,
        '--no-page', '--output', tmp_path, columns=200, rows=50,
    )  # fmt: skip
    screen.wait(lambda text: 'm/s forward' in text)
    status, out = screen.end()
    assert status == 0, out
    screen.frames()
    x, y = map(float, re.search(r'ends at (-?[\d.]+) m, (-?[\d.]+) m', out).groups())
    assert (x, y) == pytest.approx((0.6, 0.2), abs=0.05)
    assert (tmp_path / 'run.png').stat().st_size > 10_000
    assert (tmp_path / 'bag' / 'metadata.yaml').exists()


def test_a_sequence_that_is_none_ends_with_what_is_wrong(alone, tmp_path):
    file = tmp_path / 'bad.yaml'
    file.write_text('actions:\n  - fly: {}\n', encoding='utf-8')
    status, out, errors = alone(
        'demo', 'differential', '--sequence', file, '--no-page', '--output', tmp_path
    )
    assert status == 1
    assert 'fly' in out + errors
    assert 'Traceback' not in out + errors
