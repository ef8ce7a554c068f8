"""How the nodes of a robot are, and how old what they hear is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.core.robot_state import MEASURED
from agv_motion.dashboard.core.summary import OLD

if TYPE_CHECKING:
    from agv_motion.dashboard.core.robot_state import RobotState

MOST_NODES = 40


def health(robot: RobotState, now: float) -> dict[str, Any]:
    """Return every node with its level, and every topic with its age [s] and the limit for it."""
    nodes = []
    for name, node in sorted(robot.nodes.items())[:MOST_NODES]:
        told = node.told
        nodes.append({
            'name': name, 'level': 'STALE' if node.is_old(now) else told['level'],
            'message': told['message'], 'age': round(max(now - node.at, 0.0), 1),
            'values': told['values'],
        })  # fmt: skip
    inputs = [
        {'topic': topic, 'age': round(max(now - entry.at, 0.0), 1),
         'limit': OLD if topic in MEASURED else None}
        for topic, entry in sorted(robot.latest.items())
    ]  # fmt: skip
    return {'nodes': nodes, 'inputs': inputs}
