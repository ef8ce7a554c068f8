"""`agv node` says what `ros2 node` says."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')


def test_list(alone, oak):
    assert oak in alone('node', 'list')[1].splitlines()
    assert int(alone('node', 'list', '-c')[1]) >= 1


def test_info(alone, oak):
    status, out, _ = alone('node', 'info', oak)
    assert status == 0
    lines = out.splitlines()
    assert lines[:2] == [oak, '  Subscribers:']
    titles = [line.strip(' :') for line in lines[1:] if not line.startswith('    ') and line]
    assert titles == [
        'Subscribers', 'Publishers', 'Service Servers', 'Service Clients', 'Action Servers',
        'Action Clients',
    ]  # fmt: skip
    assert '    /oak/cmd_vel: geometry_msgs/msg/TwistStamped' in lines
    assert out.endswith('  Service Clients:\n\n  Action Servers:\n\n  Action Clients:\n\n')


def test_one_that_is_not_there(alone, oak):
    status, out, errors = alone('node', 'info', oak.upper())
    assert (status, out) == (1, '')
    assert errors.startswith(f"error: Unable to find node '{oak.upper()}'")
