"""The parameters of a running node as a file: the same file gives them back, to every node."""

from __future__ import annotations

import inspect
from dataclasses import fields, is_dataclass
from importlib import import_module
from types import NoneType

import pytest
import yaml

rclpy = pytest.importorskip('rclpy')

from rcl_interfaces.msg import ParameterType
from rclpy.parameter import Parameter

from agv_motion.errors import ConfigurationError
from agv_motion.nodes.catalogue import available, parameters_of
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.parameter_texts import dump, from_text, load, python
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.run import declare


def plain_nodes():
    """Return the class of every node that has parameters of ROS."""
    for name in available():
        for _, kind in inspect.getmembers(
            import_module(f'agv_motion.nodes.{name}'), inspect.isclass
        ):
            if issubclass(kind, PlainNode) and kind.__dict__.get('name') == name:
                yield kind


def values_of(node):
    """Return the values of all parameters of a node, by name, as its services give them."""
    names = sorted(node.list_parameters([], 0).names)
    return {name: node.get_parameter(name).get_parameter_value() for name in names}


def made(kind, graph, *arguments):
    """Return a node that is not run."""
    node = LiveNode(kind, context=graph.context, cli_args=['--ros-args', *arguments])
    declare(node)
    return node


def test_every_node_takes_back_what_it_tells(graph, tmp_path):
    kinds = list(plain_nodes())
    assert len(kinds) >= 14
    for kind in kinds:
        node = made(kind, graph)
        name, told = node.get_fully_qualified_name(), values_of(node)
        path = tmp_path / f'{kind.name}.yaml'
        path.write_text(dump(name, told))
        given = load(path, name)
        assert {one: python(value) for one, value in given.items()} == {
            one: python(value) for one, value in told.items()
        }
        for one, value in given.items():
            message = Parameter.from_parameter_msg(
                rclpy.parameter.ParameterMsg(name=one, value=value)
            )
            result = node.set_parameters_atomically([message])
            assert result.successful, (name, one, result.reason)
        node.destroy_node()
        again = made(kind, graph, '--params-file', str(path))
        assert {n: python(v) for n, v in values_of(again).items()} == {
            n: python(v) for n, v in told.items()
        }
        assert not again.declared.unknown
        again.destroy_node()


def test_an_empty_list_in_a_file_is_a_list_without_elements(graph, tmp_path):
    path = tmp_path / 'empty.yaml'
    path.write_text('/**:\n  ros__parameters:\n    steering_zero: []\n')
    node = made(WheelKinematics, graph, '--params-file', str(path))
    assert node.parameters.steering_zero == ()
    node.destroy_node()
    path.write_text('/**:\n  ros__parameters:\n    rate: []\n')
    with pytest.raises(ConfigurationError, match=r'rate = \[\]: expected a decimal number'):
        made(WheelKinematics, graph, '--params-file', str(path))


def test_what_is_read_at_the_start_is_refused_with_what_to_do(graph):
    node = made(MotionGenerator, graph)
    rate = node.parameters.rate
    refused = node.set_parameters_atomically([Parameter('rate', value=rate + 1.0)])
    assert not refused.successful
    assert f'start it anew with -p rate:={rate + 1.0}' in refused.reason
    assert node.parameters.rate == rate
    both = [Parameter('rate', value=rate), Parameter('share_zone', value=True)]
    assert not node.set_parameters_atomically(both).successful
    assert node.set_parameters_atomically(both[:1]).successful
    node.destroy_node()


def test_text_keeps_its_kind():
    assert from_text('1').type == ParameterType.PARAMETER_INTEGER
    assert python(from_text('[1.0, 2.5]')) == [1.0, 2.5]
    assert python(from_text('[]')) == []
    assert python(from_text('off')) is False


@pytest.mark.parametrize(
    ('text', 'value'),
    [("'12'", '12'), ('12', 12), ('1e-3', 1e-3), ('1.0e-3', 1e-3), ('true', True), ("''", ''),
     ('[]', []), ("['a', '1']", ['a', '1']), ('[1.0, -2.0]', [1.0, -2.0])],
)  # fmt: skip
def test_a_value_in_a_file_keeps_its_kind(tmp_path, text, value):
    path = tmp_path / 'p.yaml'
    path.write_text(f'/oak/node:\n  ros__parameters:\n    group:\n      x: {text}\n')
    found = python(load(path, '/oak/node')['group.x'])
    assert found == value
    assert type(found) is type(value)


@pytest.mark.parametrize('text', ['1e5', '12', '1.0', 'true', 'on', '', 'nan', '/dev/ttyUSB0', 'ä'])
def test_a_text_stays_a_text_in_the_file_that_a_node_reads(graph, tmp_path, text):
    path = tmp_path / 'p.yaml'
    path.write_text(dump('/text', {'x': Parameter('x', value=text).get_parameter_value()}))
    node = rclpy.create_node(
        'text', context=graph.context, automatically_declare_parameters_from_overrides=True,
        cli_args=['--ros-args', '--params-file', str(path)],
    )  # fmt: skip
    assert node.get_parameter('x').value == text
    assert python(load(path, '/text')['x']) == text
    node.destroy_node()


@pytest.mark.parametrize(
    ('content', 'words'),
    [
        ('/oak/node:\n  ros__parameters:\n    x: [1, a]\n', r"x = \[1, 'a'\]: expected"),
        ('/oak/node:\n  ros__parameters:\n    x: 99999999999999999999\n', 'x = 9{20}: expected'),
        ('/oak/mode:\n  ros__parameters:\n    x: 1\n', "nothing for /oak/node.*'/oak/mode'"),
    ],
)
def test_a_file_that_cannot_be_meant_is_told(tmp_path, content, words):
    path = tmp_path / 'p.yaml'
    path.write_text(content)
    with pytest.raises(ConfigurationError, match=words):
        load(path, '/oak/node')


def test_wildcards_are_left_out_on_request(tmp_path):
    path = tmp_path / 'p.yaml'
    path.write_text(
        '/**:\n  ros__parameters:\n    x: 1\n    y: 1\n/oak/node:\n  ros__parameters:\n    x: 2\n'
    )
    both = {name: python(value) for name, value in load(path, '/oak/node').items()}
    assert both == {'x': 2, 'y': 1}
    assert list(load(path, '/oak/node', wildcard=False)) == ['x']


def _texts(values, prefix=''):
    """Yield the dotted names and values of all texts among parameters, groups within groups."""
    for field in fields(values):
        value = getattr(values, field.name)
        if is_dataclass(value):
            yield from _texts(value, f'{prefix}{field.name}.')
        elif isinstance(value, str) and value:
            yield prefix + field.name, value


def test_a_text_that_a_node_tells_stays_one_for_ros2_param_load():
    """It reads each text as YAML once more, and raises where that makes a date of it."""
    changed = {
        name
        for node in available()
        for name, text in _texts(parameters_of(node)())
        if not isinstance(yaml.safe_load(text), (str, NoneType))
    }
    assert changed == {'schedule.opens', 'schedule.closes'}  # 10:00 is 600: refused, with a reason
