"""The robot that a parameter file describes, at its true size, for pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.model.footprint import Footprint


def shape_in(config: Path) -> Footprint | None:
    """Return what the robot of a parameter file covers of the floor.

    None where the file has no section for the node robot_model, whose platform is the robot's.

    Raises:
        ConfigurationError: The file cannot be read, or its robot is none.

    """
    from agv_motion.model.footprint import footprint
    from agv_motion.nodes.robot_model import RobotModelNode, RobotModelParameters
    from agv_motion.ros.parameter_arguments import sections
    from agv_motion.ros.parameter_file import load_parameters

    node = RobotModelNode.name
    if not any(key.rpartition('/')[2] == node for key, _ in sections(config)):
        return None
    return footprint(load_parameters(config, node, RobotModelParameters).model(), {})
