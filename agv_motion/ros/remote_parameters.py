"""The parameters of another node, by the services that every node of ROS has for them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters, SetParameters

from agv_motion.errors import ConfigurationError
from agv_motion.ros.remote_services import PATIENCE, call
from agv_motion.ros.suggestion import meant

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult

WORDS = {
    ParameterType.PARAMETER_NOT_SET: 'not set',
    ParameterType.PARAMETER_BOOL: 'boolean',
    ParameterType.PARAMETER_INTEGER: 'integer',
    ParameterType.PARAMETER_DOUBLE: 'double',
    ParameterType.PARAMETER_STRING: 'string',
    ParameterType.PARAMETER_BYTE_ARRAY: 'byte array',
    ParameterType.PARAMETER_BOOL_ARRAY: 'boolean array',
    ParameterType.PARAMETER_INTEGER_ARRAY: 'integer array',
    ParameterType.PARAMETER_DOUBLE_ARRAY: 'double array',
    ParameterType.PARAMETER_STRING_ARRAY: 'string array',
}
"""How `ros2 param` calls the types"""


class RemoteParameters:
    """The parameters of one node."""

    def __init__(self, node: Any, name: str, patience: float = PATIENCE) -> None:
        """Speak by ``node``, of rclpy, with the one of the full ``name``; ``patience``: [s]."""
        self._node, self._name, self._patience = node, name, patience

    def _call(self, kind: type[Any], service: str, request: Any) -> Any:
        return call(self._node, kind, f'{self._name}/{service}', request, self._patience)

    def _whole(self, answers: list[Any], names: Sequence[str]) -> list[Any]:
        """Return the answers if there is one for each name; a node leaves out all else."""
        if len(answers) != len(names):
            self._require(names)
        return answers

    def names(self, prefixes: Sequence[str] = ()) -> list[str]:
        """Return the names, in order; with ``prefixes`` those below one of them."""
        request = ListParameters.Request(prefixes=list(prefixes))
        return sorted(self._call(ListParameters, 'list_parameters', request).result.names)

    def values(self, names: Sequence[str]) -> list[ParameterValue]:
        """Return the values of parameters.

        Raises:
            ConfigurationError: There is one that the node has not.

        """
        answer = self._call(
            GetParameters, 'get_parameters', GetParameters.Request(names=list(names))
        )
        return self._whole(list(answer.values), names)

    def descriptors(self, names: Sequence[str]) -> list[ParameterDescriptor]:
        """Return the descriptors of parameters.

        Raises:
            ConfigurationError: There is one that the node has not.

        """
        answer = self._call(
            DescribeParameters, 'describe_parameters', DescribeParameters.Request(names=list(names))
        )
        return self._whole(list(answer.descriptors), names)

    def set(self, values: Mapping[str, ParameterValue]) -> list[SetParametersResult]:
        """Set parameters one after the other; return of each whether it was taken, or why not."""
        parameters = [Parameter(name=name, value=value) for name, value in values.items()]
        request = SetParameters.Request(parameters=parameters)
        return list(self._call(SetParameters, 'set_parameters', request).results)

    def _require(self, names: Sequence[str]) -> None:
        there = self.names()
        for name in names:
            if name not in there:
                msg = f"{self._name} has no parameter '{name}'{meant(name, there)}"
                raise ConfigurationError(msg)
