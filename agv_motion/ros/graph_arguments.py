"""What may be said of a robot when it is started, looked at before any of its nodes is.

So that `agv up` and the launch files refuse the same: `launch` finds a wrong value at the node that
needs it, ends, and leaves those before it running.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from agv_motion.errors import ConfigurationError
from agv_motion.ros.config import find_config
from agv_motion.ros.parameter_arguments import sections

if TYPE_CHECKING:
    from collections.abc import Mapping

    from agv_motion.ros.robot_graphs import GraphNode, RobotGraph

NAMESPACE = re.compile(r'([A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*)?')

WORDS = {'true': True, '1': True, 'false': False, '0': False}


def checked(graph: RobotGraph, given: Mapping[str, str]) -> dict[str, str]:
    """Return the arguments of a robot, its namespace bare, its file found, `true` for 1.

    Args:
        graph: Of the robot.
        given: A text for each of its arguments.

    Raises:
        ConfigurationError: One has an impossible value, or the file cannot be read.

    """
    values = {one.name: given[one.name] for one in graph.arguments}
    values['namespace'] = values['namespace'].strip('/')
    if not NAMESPACE.fullmatch(values['namespace']):
        msg = (
            f"namespace = '{values['namespace']}': write letters, digits and _, no digit first; "
            'a / may stand between two names'
        )
        raise ConfigurationError(msg)
    values['config'] = str(find_config(values['config']).resolve())
    sections(values['config'])
    asked = {node.condition for node in graph.nodes if node.condition}
    for name in sorted(asked | {'respawn', 'use_sim_time'}):
        values[name] = 'true' if is_true(name, values[name]) else 'false'
    for node in started(graph, values):
        for name, text, kind in node.values:
            typed(name, text.format(**values), kind)
    return values


def started(graph: RobotGraph, values: Mapping[str, str]) -> list[GraphNode]:
    """Return the nodes that are started with these arguments."""
    return [
        node
        for node in graph.nodes
        if not node.condition or is_true(node.condition, values[node.condition])
    ]


def typed(name: str, text: str, kind: type) -> Any:
    """Return the value of a parameter.

    Raises:
        ConfigurationError: The text is none.

    """
    if kind is bool:
        return is_true(name, text)
    try:
        return kind(text)
    except ValueError as error:
        msg = f"{name} = '{text}': expected a number such as 1.0"
        raise ConfigurationError(msg) from error


def is_true(name: str, text: str) -> bool:
    """Return what an argument says that is true or false.

    Raises:
        ConfigurationError: It is neither.

    """
    if text.lower() not in WORDS:
        msg = f"{name} = '{text}': expected true or false"
        raise ConfigurationError(msg)
    return WORDS[text.lower()]
