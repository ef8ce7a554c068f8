"""Parameters that are wrong on the command line: a line each, no trace, nothing passed over."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.ros.parameter_arguments import check_arguments, overruled, passed_over

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


ANYWHERE = '/**: {ros__parameters: {wheel_radius: 0.1}}\n'
OF_THE_NODE = (
    '/**/differential_kinematics: {ros__parameters: {track: 0.3, odometry: {max_gap: 1.0}}}\n'
)


@pytest.mark.parametrize(
    ('text', 'before', 'rule', 'vain'),
    [
        (ANYWHERE + OF_THE_NODE, False, 'track:=0.4', True),
        (ANYWHERE + OF_THE_NODE, True, 'track:=0.4', True),
        (OF_THE_NODE, True, 'track:=0.4', True),
        (OF_THE_NODE, False, 'track:=0.4', False),  # ** comes last
        (OF_THE_NODE + ANYWHERE, False, 'track:=0.4', False),
        (ANYWHERE + OF_THE_NODE, False, 'odometry.max_gap:=2.0', True),
        (ANYWHERE + OF_THE_NODE, False, 'wheel_radius:=0.2', False),
        (ANYWHERE + OF_THE_NODE, False, 'rate:=5.0', False),
        (ANYWHERE + OF_THE_NODE, False, 'differential_kinematics:track:=0.4', False),
        (ANYWHERE + OF_THE_NODE.replace('diff', 'x'), False, 'track:=0.4', False),
    ],
)
def test_a_value_that_a_file_overrules_is_told_as_rcl_takes_it(file, text, before, rule, vain):
    """What rcl makes of the same arguments is the judge."""
    rclpy = pytest.importorskip('rclpy')
    path = file(text)[-2:]
    single = ['-p', rule]
    given = ['node', '--ros-args', *(single + path if before else path + single)]
    found = list(overruled(given, NODE))
    assert len(found) == vain
    name, _, value = rule.rpartition(':=')
    if vain:
        assert f'-p {rule} counts for nothing' in found[0]
        assert path[1] in found[0]
    if 'differential_kinematics' not in rule:  # names with a namespace are not for rcl to compare
        context = rclpy.Context()
        rclpy.init(args=[*given, '-r', '__ns:=/oak'], context=context)
        node = rclpy.create_node(
            'differential_kinematics', context=context,
            automatically_declare_parameters_from_overrides=True,
        )  # fmt: skip
        taken = node.get_parameter(name).value
        node.destroy_node()
        rclpy.shutdown(context=context)
        assert (taken != float(value)) == vain
