"""`agv param` says what `ros2 param` says; what it dumps, the node takes again."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')


@pytest.mark.parametrize(
    ('words', 'output'),
    [
        (('get', 'turret_x'), 'Double values are: [0.834386001800126, 0.834386001800126, -1.18]\n'),
        (('get', 'stamped'), 'Boolean value is: True\n'),
        (('get', 'stamped', '--hide-type'), 'True\n'),
        (('get', 'executor'), 'String value is: events\n'),
        (
            ('describe', 'rate'),
            (
                'Parameter name: rate\n  Type: double\n'
                '  Description: commands per second, at least [Hz]\n  Constraints:\n'
                '    Read only: true\n    Min value: 1.0\n    Max value: 1000.0\n'
            ),
        ),
        (('set', 'residual_stop', '0.03'), 'Set parameter successful\n'),
        (('get', 'residual_stop'), 'Double value is: 0.03\n'),
    ],
)
def test_as_ros2(alone, oak, words, output):
    verb, *rest = words
    assert alone('param', verb, oak, *rest) == (0, output, '')


def test_list(alone, oak):
    names = alone('param', 'list', oak)[1].splitlines()
    assert names == sorted(names)
    assert '  wheel_radius' in names
    status, out, errors = alone('param', 'list', '--filter', 'turret_', '--param-type')
    assert (status, errors) == (0, '')
    assert f'{oak}:\n  turret_x (type: double array)\n  turret_y (type: double array)\n' in out


def test_what_is_dumped_is_taken_again(alone, oak, tmp_path):
    status, text, _ = alone('param', 'dump', oak)
    assert status == 0
    assert text.startswith(f'{oak}:\n  ros__parameters:\n    autostart: true\n')
    path = tmp_path / 'dump.yaml'
    path.write_text(text)
    status, out, errors = alone('param', 'load', oak, path)
    assert (status, errors) == (0, '')
    assert out.count(' successful\n') == text.count('\n    ') - text.count('\n    -')


@pytest.mark.parametrize(
    ('words', 'status', 'error'),
    [
        (('get', '/oak/wheel_cinematics', 'rate'), 1, "did you mean '/oak/wheel_kinematics'?"),
        (('get', '{oak}', 'rates'), 1, "has no parameter 'rates'; did you mean 'rate'?"),
        (('describe', '{oak}', 'rate', 'rates'), 1, "did you mean 'rate'?"),
        (('set', '{oak}', 'rate', '5.0'), 0, 'start it anew with -p rate:=5.0'),
        (('set', '{oak}', 'residual_stop', '-0.5'), 0, 'residual_stop out of range Min: 0.0'),
        (('set', '{oak}', 'residual_stop', '1'), 0, 'failed: residual_stop = 1: expected a decima'),
        (('load', '{oak}', '/no/such.yaml'), 1, '/no/such.yaml'),
        (('list', '--filter', '('), 1, "--filter '(' is no regular expression"),
    ],
)
def test_mistakes(alone, oak, words, status, error):
    told, _, errors = alone('param', *(word.format(oak=oak) for word in words))
    assert error in errors
    assert told == status
    assert 'Traceback' not in errors
