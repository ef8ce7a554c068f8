"""Parameters that are wrong on the command line: a line each, no trace, nothing passed over."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.ros.parameter_arguments import check_arguments, passed_over

NODE = '/oak/differential_kinematics'


@pytest.fixture
def file(tmp_path):
    """Return what writes a parameter file, and returns its arguments."""

    def write(text):
        path = tmp_path / 'p.yaml'
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return ['node', '--ros-args', '--params-file', str(path)]

    return write


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        ('track: 1.0', ("'/track' = 1.0", 'ros__parameters')),
        ('differential_kinematics: {track: 1.0}', ("'/differential_kinematics/track' = 1.0",)),
        ('ros__parameters: {track: 1.0}', ('at the top',)),
        ('- 1\n- 2\n', ('outside of the parameters',)),
        ('a: [1\nb: }', ('p.yaml, line 2',)),
        (b'\xff\xfe\x00', ('p.yaml',)),
    ],
)
def test_a_broken_file_is_one_line_that_names_it(file, text, words):
    with pytest.raises(ConfigurationError) as error:
        check_arguments(file(text))
    assert '\n' not in str(error.value)
    for word in words:
        assert word in str(error.value)


def test_a_file_that_is_not_there():
    with pytest.raises(ConfigurationError, match=r'missing\.yaml'):
        check_arguments(['node', '--ros-args', '--params-file', 'missing.yaml'])


@pytest.mark.parametrize(
    'key',
    ['/oak/differential_kinematics', 'oak/differential_kinematics', '/**', '/**/differential_*',
     '/*/differential_kinematics', 'oak: {differential_kinematics', '"/**"'],
)  # fmt: skip
def test_a_file_for_this_node_is_no_fault(file, key):
    key = key.strip('"')
    end = '}' if '{' in key else ''
    given = file(f'{key}: {{ros__parameters: {{track: 0.3}}}}{end}\n')
    check_arguments(given)
    if 'differential_*' not in key:
        assert not list(passed_over(given, NODE))


@pytest.mark.parametrize(
    'key',
    ['/oak/differntial_kinematics', '/ash/differential_kinematics', 'differential_kinematics'],
)
def test_a_file_for_another_node_is_told_with_what_was_meant(file, key):
    (line,) = passed_over(file(f'{key}: {{ros__parameters: {{track: 0.3}}}}\n'), NODE)
    assert f'has nothing for {NODE}' in line
    assert f"did you mean '/{key.strip('/')}'?" in line


def test_an_empty_file_says_nothing(file):
    check_arguments(file(''))
    assert not list(passed_over(file(''), NODE))


def test_an_argument_for_another_node():
    given = ['node', '--ros-args', '-p', 'differntial_kinematics:track:=0.3', '-p', 'track:=0.3']
    (line,) = passed_over(given, '/differential_kinematics')
    assert "for the node 'differntial_kinematics'" in line


def test_what_is_no_argument_of_ros_is_left_alone():
    assert not list(passed_over(['node', '--params-file', 'no.yaml', '--ros-args', '--'], NODE))
