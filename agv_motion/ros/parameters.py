"""ROS parameters from a dataclass of `agv_motion.parameters`: declared once, validated first."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    SetParametersResult,
)
from rclpy.parameter import Parameter

from agv_motion.errors import AgvMotionError, ConfigurationError
from agv_motion.kinematics.differential_platform import DifferentialBaseParameters
from agv_motion.kinematics.omni_platform import OmniBaseParameters
from agv_motion.kinematics.platform import PlatformParameters
from agv_motion.model.frames import OWN, SHARED, FrameParameters
from agv_motion.parameters import moved, nested, rows
from agv_motion.ros.parameter_changes import empty_array
from agv_motion.ros.parameter_types import wrong_type
from agv_motion.ros.quotation import told
from agv_motion.ros.suggestion import meant
from agv_motion.ros.yaml_readings import as_written

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from _typeshed import DataclassInstance
    from rclpy.node import Node

    from agv_motion.parameters import Spec

OF_EVERY_NODE = 'use_sim_time', 'start_type_description_service', 'autostart', 'executor'
"""Parameters that nodes have beside their own"""

OF_THE_PLATFORM = frozenset(
    name
    for kind in (
        PlatformParameters,
        OmniBaseParameters,
        DifferentialBaseParameters,
        FrameParameters,
    )
    for name, _, _ in rows(kind)
) | {*OWN, *SHARED}
"""Parameters that a file tells once for all nodes, under ``/**``; not every node needs them."""

T = TypeVar('T', bound='DataclassInstance')


class DeclaredParameters(Generic[T]):
    """The parameters of one node, and the door through which they change.

    Groups (fields that are dataclasses themselves) become dotted names: ``csv.file``.
    """

    def __init__(self, node: Node, kind: type[T], accept: Callable[[T], None]) -> None:
        """Declare every row of ``kind`` on ``node``.

        Args:
            node: The node to declare on.
            kind: A dataclass of rows and groups, all with defaults.
            accept: Called with the new values before a dynamic change takes effect; may refuse it
                by raising an :class:`AgvMotionError`.

        Raises:
            ConfigurationError: The values given contradict each other or their rows.
            InvalidParameterValueException: A scalar lies outside its range.
            ConfigurationError: A value has another type than its default (1 for 1.0).

        """
        self._accept = accept
        self._types = dict(_types(kind, ''))
        self._units = dict(_units(kind, ''))
        given = getattr(node, '_parameter_overrides', {})  # rclpy has no other way to ask
        for name, parameter in given.items():
            if parameter.value is None and name in self._types:
                parameter = given[name] = empty_array(name, self._types[name])  # noqa: PLW2901
            parameter = given[name] = self.as_written(parameter)  # noqa: PLW2901
            wrong = self.wrong(name, parameter.value) if name in self._types else ''
            if wrong:
                raise ConfigurationError(wrong)
        self.values: T = _declare(node, kind)
        self.unknown = tuple(
            self._no_parameter(name)
            for name in given
            if not self._is_known(name) and name not in OF_THE_PLATFORM
        )
        """what was given and is no parameter of the node, with what may have been meant"""
        self.given = frozenset(texts(self.values))
        """texts that whoever started the node gave, names of files among them"""
        node.add_on_set_parameters_callback(self._on_set)

    def as_written(self, parameter: Parameter, present: Any = None) -> Parameter:
        """Return a parameter with what was written, where YAML has made something else of it.

        Args:
            parameter: As it has come.
            present: What it is now; None where it is nothing yet.

        """
        name = parameter.name
        if name not in self._types:
            return parameter
        value = as_written(parameter.value, self._types[name], self._units[name], present)
        return parameter if value is parameter.value else Parameter(name, value=value)

    def wrong(self, name: str, value: Any) -> str:
        """Return why a parameter cannot have this value: no such name, or type; empty if it may."""
        if not self._is_known(name):
            return self._no_parameter(name)
        return wrong_type(name, value, self._types[name]) if name in self._types else ''

    def _is_known(self, name: str) -> bool:
        return name in self._types or name in OF_EVERY_NODE or name.startswith('qos_overrides.')

    def _no_parameter(self, name: str) -> str:
        new = moved(name)
        if new:
            return f"no parameter '{name}' any more; it is '{new}' now"
        return f"no parameter '{name}'{meant(name, [*self._types, *OF_EVERY_NODE])}"

    def _on_set(self, changes: list[Parameter]) -> SetParametersResult:
        try:
            candidate = changed(self.values, {each.name: each.value for each in changes})
            if candidate != self.values:
                self._accept(candidate)
        except AgvMotionError as error:
            return SetParametersResult(successful=False, reason=told(error, self.given))
        except TypeError as error:
            return SetParametersResult(successful=False, reason=str(error))
        self.values = candidate
        return SetParametersResult(successful=True)


def filled(kind: type[T], given: Mapping[str, Any], node: str) -> T:
    """Return parameters with the values ``given`` by dotted name, and defaults for the rest.

    Raises:
        ConfigurationError: One is no parameter of the ``node``, of another type, or out of range.

    """
    known, units = dict(_types(kind, '')), dict(_units(kind, ''))
    own = {
        name: as_written(value, known[name], units[name], None)
        for name, value in given.items()
        if name in known
    }
    for name, value in own.items():
        wrong = wrong_type(name, value, known[name])
        if wrong:
            raise ConfigurationError(wrong)
    unknown = set(given) - set(known) - OF_THE_PLATFORM - set(OF_EVERY_NODE)
    if unknown:
        told = ', '.join(f'{name} (it is {new} now)' if (new := moved(name)) else name
                         for name in sorted(unknown))  # fmt: skip
        msg = f'{node} has no parameter {told}'
        raise ConfigurationError(msg)
    values: T = _filled(kind, own, '')
    return values


def _filled(kind: type[Any], given: Mapping[str, Any], prefix: str) -> Any:
    own = {name: prefix + name for name, _, _ in rows(kind)}
    values = {name: _plain(given[full]) for name, full in own.items() if full in given}
    groups = {name: _filled(group, given, f'{prefix}{name}.') for name, group in nested(kind)}
    return kind(**values, **groups)


def changed(values: T, changes: Mapping[str, Any]) -> T:
    """Return parameters with other values, by dotted name; names of others pass by.

    Raises:
        AgvMotionError: A value is out of range, or does not go with the others.

    """
    candidate: T = _with(values, {name: _plain(value) for name, value in changes.items()})
    return candidate


def _types(kind: type[Any], prefix: str) -> Iterator[tuple[str, Any]]:
    """Yield name and type of every parameter."""
    for name, origin, _ in rows(kind):
        yield prefix + name, origin
    for name, group in nested(kind):
        yield from _types(group, f'{prefix}{name}.')


def _units(kind: type[Any], prefix: str) -> Iterator[tuple[str, str]]:
    """Yield name and unit of every parameter."""
    for name, _, spec in rows(kind):
        yield prefix + name, spec.unit
    for name, group in nested(kind):
        yield from _units(group, f'{prefix}{name}.')


def _declare(node: Node, kind: type[Any]) -> Any:
    declared = node.declare_parameters('', list(_described(kind, '')))
    return _filled(kind, {parameter.name: parameter.value for parameter in declared}, '')


def _described(kind: type[Any], prefix: str) -> Iterator[tuple[str, Any, ParameterDescriptor]]:
    """Yield name, default and descriptor of every parameter."""
    defaults = kind()
    for name, origin, spec in rows(kind):
        yield prefix + name, getattr(defaults, name), _descriptor(spec, origin)
    for name, group in nested(kind):
        yield from _described(group, f'{prefix}{name}.')


def _descriptor(spec: Spec, origin: Any) -> ParameterDescriptor:
    """Return what ``ros2 param describe`` shows; rclpy checks the range of scalars by itself.

    Of an empty array rclpy cannot tell the type: of arrays it must not insist on it, `wrong` does.
    """
    descriptor = ParameterDescriptor(
        description=f'{spec.description} [{spec.unit}]' if spec.unit else spec.description,
        additional_constraints=f'one of {", ".join(spec.choices)}' if spec.choices else '',
        read_only=not spec.dynamic,
        dynamic_typing=hasattr(origin, '__args__'),
    )
    if spec.between and origin is float:
        low, high = spec.between
        descriptor.floating_point_range = [FloatingPointRange(from_value=low, to_value=high)]
    elif spec.between and origin is int:
        low, high = (int(bound) for bound in spec.between)
        descriptor.integer_range = [IntegerRange(from_value=low, to_value=high, step=1)]
    return descriptor


def texts(values: DataclassInstance) -> Iterator[str]:
    """Yield every text among parameters, names of files among them."""
    for name, _, _ in rows(type(values)):
        value = getattr(values, name)
        if isinstance(value, str):
            yield value
    for name, _ in nested(type(values)):
        yield from texts(getattr(values, name))


def _plain(value: Any) -> Any:
    """Return arrays as tuples, as the dataclasses hold them."""
    return value if isinstance(value, (str, bool, int, float)) else tuple(value)


def _with(values: Any, changes: Mapping[str, Any]) -> Any:
    """Return ``values`` with others, all at once: what goes together is never judged by halves."""
    own = {name: value for name, value in changes.items() if hasattr(values, name)}
    for group in {name.partition('.')[0] for name in changes if '.' in name}:
        if hasattr(values, group):
            inner = {
                n.partition('.')[2]: v for n, v in changes.items() if n.startswith(f'{group}.')
            }
            own[group] = _with(getattr(values, group), inner)
    return replace(values, **own)
