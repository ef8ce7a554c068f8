"""Parameters of a robot's nodes, over the graph: read with all that is told of them, and set."""

from __future__ import annotations

import re
from math import isfinite
from typing import TYPE_CHECKING, Any, NamedTuple

from rcl_interfaces.msg import Parameter as ParameterMessage
from rcl_interfaces.msg import ParameterType, ParameterValue
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    ListParameters,
    SetParametersAtomically,
)
from rclpy.parameter import parameter_value_to_python

from agv_motion.dashboard.core.names import namespace_of
from agv_motion.dashboard.server.fleet import RefusedError

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.nodes.robot_services import RobotServices

    Values = dict[str, Any]

MOST_NODES = 40
MOST_PARAMETERS = 500
"""of one node"""
CHOICES = 'one of '
"""what precedes the choices among the constraints of a parameter"""

_UNIT = re.compile(r'(?P<text>.*) \[(?P<unit>[^\[\]]{1,20})\]$', re.DOTALL)
_FIELDS = {
    ParameterType.PARAMETER_BOOL: ('bool_value', bool),
    ParameterType.PARAMETER_INTEGER: ('integer_value', int),
    ParameterType.PARAMETER_DOUBLE: ('double_value', float),
    ParameterType.PARAMETER_STRING: ('string_value', str),
    ParameterType.PARAMETER_BOOL_ARRAY: ('bool_array_value', bool),
    ParameterType.PARAMETER_INTEGER_ARRAY: ('integer_array_value', int),
    ParameterType.PARAMETER_DOUBLE_ARRAY: ('double_array_value', float),
    ParameterType.PARAMETER_STRING_ARRAY: ('string_array_value', str),
}
_ARRAYS = frozenset(number for number, (field, _) in _FIELDS.items() if 'array' in field)


class NodeParameters(NamedTuple):
    """What a node tells of its parameters."""

    node: str
    rows: list[dict[str, Any]]
    """name, value, unit, low, high, text, choices, dynamic of each"""


class RobotParameters:
    """Reads and sets parameters, without waiting: each answer comes to a callback."""

    def __init__(self, services: RobotServices, nodes: Callable[[], list[tuple[str, str]]]) -> None:
        """Ask nothing yet.

        Args:
            services: To call the nodes by.
            nodes: Returns name and namespace of every node on the graph.

        """
        self._services, self._nodes = services, nodes

    def nodes(self, robot: str) -> list[str]:
        """Return the names of the nodes of a robot that have parameters."""
        namespace = namespace_of(robot)
        found = {
            name for name, where in self._nodes()
            if where.rstrip('/') == namespace and not name.startswith('_')
            and self._services.has(f'{namespace}/{name}/list_parameters')
        }  # fmt: skip
        return sorted(found)[:MOST_NODES]

    def read(self, robot: str, answer: Callable[[list[NodeParameters]], None]) -> None:
        """Read all parameters of all nodes of a robot; nodes that do not answer are left out."""
        names = self.nodes(robot)
        found: list[NodeParameters] = []
        left = len(names)

        def take(one: NodeParameters | None) -> None:
            nonlocal left
            left -= 1
            if one is not None:
                found.append(one)
            if left == 0:
                answer(sorted(found))

        if not names:
            answer([])
        for name in names:
            self._read_node(namespace_of(robot), name, take)

    def get(
        self, robot: str, node: str, names: list[str], answer: Callable[[Values | None], None]
    ) -> None:
        """Read some parameters of one node; None if it does not answer."""

        def take(response: Any) -> None:
            if isinstance(response, Exception):
                answer(None)
            else:
                values = map(parameter_value_to_python, response.values)
                answer(dict(zip(names, map(_plain, values), strict=False)))

        place = f'{namespace_of(robot)}/{node}'
        request = GetParameters.Request(names=names)
        self._services.call(GetParameters, f'{place}/get_parameters', request, take)

    def set(
        self, robot: str, node: str, values: Values, answer: Callable[[str | Exception], None]
    ) -> None:
        """Set parameters of a node, all or none; ``answer`` comes when it has read them back.

        Raises:
            RefusedError: The robot has no such node.

        """
        if node not in self.nodes(robot):
            msg = f"no node '{node}' with parameters; there are {', '.join(self.nodes(robot))}"
            raise RefusedError(msg)
        place = f'{namespace_of(robot)}/{node}'

        def typed(response: Any) -> None:
            if isinstance(response, Exception):
                answer(response)
                return
            if len(response.values) != len(values):  # rclpy leaves out what is not there
                answer(RefusedError(f"{node} has no parameter '{', '.join(values)[:100]}'"))
                return
            try:
                messages = [
                    ParameterMessage(name=name, value=_value(name, value, now.type))
                    for (name, value), now in zip(values.items(), response.values, strict=True)
                ]
            except (RefusedError, ValueError) as error:
                answer(error)
                return
            request = SetParametersAtomically.Request(parameters=messages)
            name = f'{place}/set_parameters_atomically'
            self._services.call(SetParametersAtomically, name, request, told)

        def told(response: Any) -> None:
            if isinstance(response, Exception):
                answer(response)
            elif not response.result.successful:
                answer(RefusedError(response.result.reason or 'refused without a reason'))
            else:
                self.get(robot, node, list(values), read_back)

        def read_back(now: Values | None) -> None:
            shown = ', '.join(f'{name} = {value}' for name, value in (now or {}).items())
            answer(f'{node}: {shown}'[:300])

        request = GetParameters.Request(names=list(values))
        self._services.call(GetParameters, f'{place}/get_parameters', request, typed)

    def _read_node(
        self, namespace: str, node: str, take: Callable[[NodeParameters | None], None]
    ) -> None:
        """Ask one node for names, then for what they mean, then for their values."""
        place = f'{namespace}/{node}'
        names: list[str] = []
        described: list[Any] = []

        def listed(response: Any) -> None:
            if isinstance(response, Exception):
                take(None)
                return
            names.extend(sorted(response.result.names)[:MOST_PARAMETERS])
            request = DescribeParameters.Request(names=names)
            name = f'{place}/describe_parameters'
            self._services.call(DescribeParameters, name, request, told)

        def told(response: Any) -> None:
            if isinstance(response, Exception):
                take(None)
                return
            described.extend(response.descriptors)
            request = GetParameters.Request(names=names)
            self._services.call(GetParameters, f'{place}/get_parameters', request, valued)

        def valued(response: Any) -> None:
            if isinstance(response, Exception):
                take(None)
                return
            rows = [_row(*pair) for pair in zip(described, response.values, strict=False)]
            take(NodeParameters(node, rows))

        request = ListParameters.Request()
        self._services.call(ListParameters, f'{place}/list_parameters', request, listed)


def _row(descriptor: Any, value: Any) -> dict[str, Any]:
    """Return what there is to know of a parameter."""
    found = _UNIT.match(descriptor.description)
    low = high = None
    for one in (*descriptor.floating_point_range, *descriptor.integer_range):
        low, high = one.from_value, one.to_value
    constraints = descriptor.additional_constraints
    _, choice, choices = constraints.partition(CHOICES)
    return {
        'name': descriptor.name,
        'value': _plain(parameter_value_to_python(value)),
        'unit': found['unit'] if found else '',
        'text': found['text'] if found else descriptor.description,
        'low': _plain(low),
        'high': _plain(high),
        'choices': choices.split(', ') if choice else [],
        'dynamic': not descriptor.read_only,
    }


def _plain(value: Any) -> Any:
    """Return a value as JSON has it."""
    if value is None or isinstance(value, (bool, int, str)):
        return value
    if isinstance(value, float):
        return value if isfinite(value) else None
    return [_plain(item.decode() if isinstance(item, bytes) else item) for item in value]


def _value(name: str, value: Any, kind: int) -> ParameterValue:
    """Return a value as a parameter of the type that it has now.

    Raises:
        RefusedError: It is of another type, or the node has no such parameter.

    """
    if kind not in _FIELDS:
        kind = _guessed(name, value)
    field, element = _FIELDS[kind]
    if kind in _ARRAYS:
        if not isinstance(value, list):
            msg = f'{name} = {str(value)[:60]!r}: expected a list'
            raise RefusedError(msg)
        made: Any = [_element(name, item, element) for item in value]
    else:
        made = _element(name, value, element)
    return ParameterValue(type=kind, **{field: made})


def _element(name: str, value: Any, kind: type[Any]) -> Any:
    if kind is float and type(value) is int and abs(value) < 2**1023:
        value = float(value)
    if kind is int and isinstance(value, float) and value.is_integer():
        value = int(value)
    if type(value) is not kind or (kind is float and not isfinite(value)):
        words = {float: 'a finite number', int: 'a whole number', bool: 'true or false',
                 str: 'a text'}  # fmt: skip
        msg = f'{name} = {str(value)[:60]!r}: expected {words[kind]}'
        raise RefusedError(msg)
    if kind is int and not -(2**63) <= value < 2**63:
        msg = f'{name} = {value}: does not fit 64 bits'
        raise RefusedError(msg)
    return value


def _guessed(name: str, value: Any) -> int:
    """Return a type for a parameter that has none yet: an array that is empty."""
    if isinstance(value, list):
        for number, (_, element) in _FIELDS.items():
            if number in _ARRAYS and (not value or type(value[0]) is element):
                return int(number)
    msg = f'no parameter {name!r}'
    raise RefusedError(msg)
