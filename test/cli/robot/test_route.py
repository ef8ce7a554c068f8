"""`agv route`, as a person types it."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')


def test_it_tells_how_the_example_would_be_followed_and_draws_it(alone, tmp_path):
    picture = tmp_path / 'route.png'
    status, out, errors = alone('route', 'route_example.yaml', '--plot', picture)
    assert status == 0, errors
    assert '6 waypoints, 11.50 m' in out
    assert 'v(dphi)' in out
    assert picture.read_bytes().startswith(b'\x89PNG')


def test_what_is_wrong_is_told_in_one_line(alone, tmp_path):
    config = tmp_path / 'mine.yaml'
    for text, reason in (
        ('route_follower: {ros__parameters: {folow: {}}}', "did you mean 'follow'?"),
        ('route_follower: {ros__parameters: {rate: 20}}', 'rate = 20: expected a decimal number'),
        (
            '/**: {ros__parameters: {follow: {v_dn: [0.0, 1.0, 0.0, 2.0]}}}',
            'v_dn: two rows overlap at x = 0',
        ),
        ('/**/motion_generator: {}', 'no section /**/route_follower'),
    ):
        config.write_text(text)
        status, _, errors = alone('route', 'route_example.yaml', '--config', config)
        assert status == 1
        assert reason in errors
        assert errors.count('\n') == 1
