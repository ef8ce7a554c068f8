"""What the launch files say, from the one table of robots in `ros/robot_graphs.py`.

The launch package is there only where ROS is installed, so it is imported when it is asked for.
"""

from __future__ import annotations

import re
from importlib import import_module
from typing import TYPE_CHECKING, Any

from agv_motion.ros.config import find_config
from agv_motion.ros.graph_arguments import checked

if TYPE_CHECKING:
    from agv_motion.ros.robot_graphs import GraphNode, RobotGraph

RESPAWN_DELAY = 2.0
"""[s]"""


def described(graph: RobotGraph) -> Any:
    """Return the launch description of a robot."""
    actions = import_module('launch.actions')
    declared = [
        actions.DeclareLaunchArgument(
            one.name,
            default_value=str(find_config(one.default)) if one.name == 'config' else one.default,
            description=one.text,
        )
        for one in graph.arguments
    ]
    first = actions.OpaqueFunction(function=check_arguments, args=[graph])
    nodes = [_node(node) for node in graph.nodes]
    return import_module('launch').LaunchDescription([*declared, first, *nodes])


def check_arguments(context: Any, graph: RobotGraph) -> None:
    """Check the arguments of a launch before any node starts.

    Args:
        context: Of the launch; goes on with the path of the `config` that was found.
        graph: Of the robot.

    Raises:
        ConfigurationError: One has an impossible value, or the file cannot be read: launch itself
            would start the nodes without it, with the geometry of another robot.

    """
    context.launch_configurations.update(checked(graph, context.launch_configurations))


def _node(node: GraphNode) -> Any:
    value_of = import_module('launch.substitutions').LaunchConfiguration
    typed = import_module('launch_ros.parameter_descriptions').ParameterValue
    conditions = import_module('launch.conditions')
    own = {name: typed(_filled(text), value_type=kind) for name, text, kind in node.values}
    return import_module('launch_ros.actions').Node(
        package='agv_motion',
        executable=node.name,
        name=node.name,
        namespace=value_of('namespace'),
        parameters=[value_of('config'), own],
        remappings=[(source, _filled(target)) for source, target in node.remappings],
        output='screen',
        respawn=value_of('respawn'),
        respawn_delay=RESPAWN_DELAY,
        condition=conditions.IfCondition(value_of(node.condition)) if node.condition else None,
    )


def _filled(text: str) -> list[Any]:
    """Return a text with arguments in braces as what launch puts together later."""
    value_of = import_module('launch.substitutions').LaunchConfiguration
    parts = re.split(r'\{(\w+)\}', text)
    return [value_of(part) if i % 2 else part for i, part in enumerate(parts) if i % 2 or part]
