"""The parameters of a running node as a file: the same file gives them back, to every node."""

from __future__ import annotations

import inspect
from importlib import import_module
from pathlib import Path

import pytest
import yaml

rclpy = pytest.importorskip('rclpy')

from rcl_interfaces.msg import ParameterType
from rclpy.parameter import Parameter, parameter_dict_from_yaml_file

from agv_motion.errors import ConfigurationError
from agv_motion.nodes.catalogue import available, parameters_of
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.parameters import nested, rows
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.parameter_texts import dump, from_text, load, python
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.run import declare
from agv_motion.ros.yaml_readings import as_written


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


def by_ros2(path, values, name='/any'):
    """Return what `ros2 param load` sends of what `ros2 param dump` wrote into a file."""
    content = {}
    for dotted, value in values.items():
        *groups, last = dotted.split('.')
        place = content
        for group in groups:
            place = place.setdefault(group, {})
        place[last] = value
    whole = {name: {'ros__parameters': content}}
    path.write_text(yaml.dump(whole, default_flow_style=False))
    sent = parameter_dict_from_yaml_file(str(path), use_wildcard=True)
    return [Parameter.from_parameter_msg(one) for one in sent.values()]


CONFIGS = sorted((Path(__file__).parents[2] / 'config').glob('*.yaml'))


def configured(kind):
    """Return the files of the package that have something for a node."""
    return [path for path in CONFIGS if f'/{kind.name}:' in path.read_text()]


def test_every_node_takes_back_what_it_tells(graph, tmp_path):
    """From the genuine ros2 param load, too.

    That reads each text as YAML 1.1 once more: 10:00 comes as 600, 1e-06 as a text.
    """
    kinds, files = list(plain_nodes()), 0
    assert len(kinds) >= 14
    for kind in kinds:
        for number, given in enumerate(
            [('--params-file', str(path)) for path in configured(kind)] or [()]
        ):
            node = made(kind, graph, *given)
            name, values = node.get_fully_qualified_name(), values_of(node)
            told = {one: python(value) for one, value in values.items()}
            sent = by_ros2(tmp_path / 'ros2.yaml', told)
            path = tmp_path / 'dump.yaml'
            if number == 0:
                path.write_text(dump(name, values))
                kept = load(path, name)
                assert {one: python(value) for one, value in kept.items()} == told
                sent += [
                    Parameter.from_parameter_msg(rclpy.parameter.ParameterMsg(name=n, value=v))
                    for n, v in kept.items()
                ]
            for one in sent:
                result = node.set_parameters_atomically([one])
                assert result.successful, (kind.name, given, one.name, result.reason)
            assert {one: python(value) for one, value in values_of(node).items()} == told
            node.destroy_node()
            if number == 0:
                again = made(kind, graph, '--params-file', str(path))
                assert {one: python(value) for one, value in values_of(again).items()} == told
                assert not again.declared.unknown
                again.destroy_node()
            files += bool(given)
    assert files >= 10


def default_rows(kind, prefix=''):
    """Yield name, type, unit and default of every parameter, groups within groups."""
    for name, wanted, spec in rows(kind):
        yield prefix + name, wanted, spec.unit, getattr(kind(), name)
    for name, group in nested(kind):
        yield from default_rows(group, f'{prefix}{name}.')


def test_every_default_survives_ros2_param_load(tmp_path):
    for node in available():
        of = {name: row for name, *row in default_rows(parameters_of(node))}
        told = {n: list(v) if isinstance(v, tuple) else v for n, (_, _, v) in of.items()}
        for sent in by_ros2(tmp_path / 'dump.yaml', told):
            wanted, unit, _ = of[sent.name]
            value = told[sent.name]
            found = as_written(sent.value, wanted, unit, value)
            assert (list(found) if isinstance(value, list) else found) == value, (node, sent.name)


def test_a_time_of_day_may_come_in_minutes(graph, tmp_path):
    node = made(MotionGenerator, graph)
    change = by_ros2(tmp_path / 'p.yaml', {'schedule': {'opens': '10:30', 'closes': '08:05'}})
    assert {one.name: one.value for one in change} == {
        'schedule.opens': 630, 'schedule.closes': '08:05',
    }  # fmt: skip
    assert node.set_parameters_atomically(change).successful
    assert node.get_parameter('schedule.opens').value == '10:30'
    assert node.parameters.schedule.opens == '10:30'
    for wrong in (1440, -1, 10.0, True):
        refused = node.set_parameters_atomically([Parameter('schedule.opens', value=wrong)])
        assert not refused.successful
        assert f'schedule.opens = {wrong!r}: expected a text' in refused.reason
    assert node.parameters.schedule.opens == '10:30'
    node.destroy_node()
    node = made(MotionGenerator, graph, '-p', 'schedule.opens:=545')
    assert node.parameters.schedule.opens == '09:05'
    node.destroy_node()


def test_an_empty_list_in_a_file_is_a_list_without_elements(graph, tmp_path):
    path = tmp_path / 'empty.yaml'
    path.write_text('/**:\n  ros__parameters:\n    steering_zero: []\n')
    node = made(WheelKinematics, graph, '--params-file', str(path))
    assert node.parameters.steering_zero == ()
    node.destroy_node()
    path.write_text('/**:\n  ros__parameters:\n    turret_x: []\n')  # the default is none
    with pytest.raises(ConfigurationError, match=r'0 values in turret_x, 3 in turret_y'):
        made(WheelKinematics, graph, '--params-file', str(path))
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
