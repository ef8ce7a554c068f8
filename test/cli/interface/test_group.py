"""`agv interface` says what `ros2 interface` says."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')


def test_show(alone):
    assert alone('interface', 'show', 'std_srvs/srv/SetBool') == (
        0,
        (
            'bool data # e.g. for hardware enabling / disabling\n---\n'
            'bool success   # indicate successful run of triggered service\n'
            'string message # informational, e.g. for error messages\n'
        ),
        '',
    )
    out = alone('interface', 'show', 'geometry_msgs/msg/TwistStamped', '--no-comments')[1]
    assert out.startswith(
        'std_msgs/Header header\n\tbuiltin_interfaces/Time stamp\n\t\tint32 sec\n'
        '\t\tuint32 nanosec\n\tstring frame_id\nTwist twist\n\tVector3  linear\n'
    )


def test_list(alone):
    out = alone('interface', 'list')[1].splitlines()
    assert out[0] == 'Messages:'
    assert out.index('    std_msgs/msg/String') < out.index('Services:')
    assert alone('interface', 'list', '-s')[1].startswith('Services:\n')


def test_mistakes(alone):
    status, _, errors = alone('interface', 'show', 'std_srvs/SetBool')
    assert status == 1
    assert "did you mean 'std_srvs/srv/SetBool'?" in errors
    status, _, errors = alone('interface', 'show', '-', stdin=-3)
    assert (status, errors) == (1, 'error: the passed value is empty\n')
