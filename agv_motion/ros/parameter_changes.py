"""What a request to set parameters changes, and what it may not.

Who gives a node the value that it has changes nothing: so the parameters of a running node, written
to a file, can be given to it again, those among them that are read at its start alone as well.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.parameter import Parameter

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rclpy.node import Node

ARRAYS = {
    bool: Parameter.Type.BOOL_ARRAY,
    int: Parameter.Type.INTEGER_ARRAY,
    float: Parameter.Type.DOUBLE_ARRAY,
    str: Parameter.Type.STRING_ARRAY,
}


def empty_array(name: str, wanted: Any) -> Parameter:
    """Return what a file means by ``name: []``, of which rcl makes a parameter without a value.

    Args:
        name: Of the parameter.
        wanted: Its type: float, int, bool, str, or a tuple of one of them.

    """
    kinds = getattr(wanted, '__args__', (wanted,))
    return Parameter(name, ARRAYS[kinds[0]], [])


def differing(node: Node, asked: Sequence[Parameter]) -> list[Parameter]:
    """Return those of the parameters asked for that have another value now."""
    return [one for one in asked if not _same(one, node.get_parameter_or(one.name, NOTHING))]


NOTHING = Parameter('nothing', Parameter.Type.NOT_SET, None)


def _same(one: Parameter, other: Parameter) -> bool:
    values = [list(each.value) if _is_array(each) else each.value for each in (one, other)]
    alike = one.type_ is other.type_ or values == [[], []]
    return alike and values[0] == values[1]


def _is_array(parameter: Parameter) -> bool:
    return parameter.value is not None and not isinstance(parameter.value, (str, bool, int, float))


def refusal(node: Node, asked: Sequence[Parameter]) -> str:
    """Return why parameters cannot change while the node runs, and what to do; or nothing."""
    for one in asked:
        if not node.has_parameter(one.name) or not node.describe_parameter(one.name).read_only:
            continue
        value = list(one.value) if _is_array(one) else one.value
        shown = str(value).lower() if isinstance(value, bool) else value
        return (
            f'Trying to set a read-only parameter: {one.name}. It is read when the node starts: '
            f'start it anew with -p {one.name}:={shown} or a parameter file'
        )
    return ''
