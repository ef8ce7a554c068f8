"""Values of parameters as text: as a person types one, and as a file holds those of a node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import yaml
from rcl_interfaces.msg import ParameterType, ParameterValue
from rclpy.parameter import get_parameter_value, parameter_value_to_python

from agv_motion.errors import ConfigurationError
from agv_motion.ros.parameter_arguments import VALUES, is_for, sections
from agv_motion.ros.suggestion import meant

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path


def from_text(text: str) -> ParameterValue:
    """Return what a person has typed, as YAML: ``1`` a whole number, ``1.0`` a decimal one."""
    return get_parameter_value(text)


def python(value: ParameterValue) -> Any:
    """Return a value in Python: True, 1, 1.0, a text, a list of them, or None."""
    found = parameter_value_to_python(value)
    return found if found is None or isinstance(found, (bool, int, float, str)) else list(found)


def dump(name: str, values: Mapping[str, ParameterValue]) -> str:
    """Return a parameter file for the node ``name``, as `ros2 param dump` writes it."""
    content: dict[str, Any] = {}
    for dotted, value in values.items():
        *groups, last = dotted.split('.')
        place = content
        for group in groups:
            place = place.setdefault(group, {})
        place[last] = python(value)
    whole = {name: {VALUES: content}}
    text: str = yaml.dump(whole, Dumper=_Dumper, default_flow_style=False, allow_unicode=True)
    return text


class _Dumper(yaml.SafeDumper):
    """Puts texts into quotation marks that rcl would take for numbers, and YAML 1.1 would not."""


def _quoted(dumper: yaml.SafeDumper, text: str) -> yaml.ScalarNode:
    try:
        float(text)
    except ValueError:
        return dumper.represent_str(text)
    return dumper.represent_scalar('tag:yaml.org,2002:str', text, style="'")


_Dumper.add_representer(str, _quoted)


def load(path: Path, node: str, *, wildcard: bool = True) -> dict[str, ParameterValue]:
    """Return the parameters that a file gives to a node, by dotted name.

    Args:
        path: A ROS parameter file; of several values for one parameter the last one counts.
        node: Full name.
        wildcard: Whether what stands under ``/**`` is for it too.

    Raises:
        ConfigurationError: The file cannot be read, has nothing for the node, or a value is none
            of a parameter.

    """
    found = sections(path)
    own = [(key, values) for key, values in found if is_for(key, node)]
    if not wildcard:
        own = [(key, values) for key, values in own if '*' not in key]
    if not own:
        there = [key for key, _ in found]
        msg = f'{path} has nothing for {node}: it is for {", ".join(there)}{meant(node, there)}'
        raise ConfigurationError(msg)
    return {
        name: _message(value, f'{path}: {name}')
        for _, values in own
        for name, value in _dotted(values, '')
    }


def _dotted(values: Mapping[str, Any], prefix: str) -> Iterator[tuple[str, Any]]:
    for name, value in values.items():
        if isinstance(value, dict):
            yield from _dotted(value, f'{prefix}{name}.')
        else:
            yield f'{prefix}{name}', value


FIELDS = {bool: 'bool', int: 'integer', float: 'double', str: 'string'}
"""How the message of a value calls what Python calls so"""


def _message(value: Any, where: str) -> ParameterValue:
    """Return a value with the type that it has in YAML: '12' in quotation marks is a text."""
    listed = isinstance(value, list)
    kinds = set(map(type, value)) if listed else {type(value)}
    kind = kinds.pop() if len(kinds) == 1 else None if kinds else float
    if kind not in FIELDS or (kind is int and not _fits(value)):
        msg = (
            f'{where} = {value!r}: expected true or false, a number, a text, or a list of things '
            'of one of these kinds'
        )
        raise ConfigurationError(msg)
    array = '_array' if listed else ''
    number = getattr(ParameterType, f'PARAMETER_{FIELDS[kind]}{array}'.upper())
    return ParameterValue(type=number, **{f'{FIELDS[kind]}{array}_value': value})


def _fits(value: Any) -> bool:
    return all(-(2**63) <= one < 2**63 for one in (value if isinstance(value, list) else [value]))
