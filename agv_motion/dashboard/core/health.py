"""How the nodes of a robot are, and how old what they hear is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.core.robot_state import MEASURED
from agv_motion.dashboard.core.summary import NODE_OLD, OLD

if TYPE_CHECKING:
    from agv_motion.dashboard.core.robot_state import RobotState

MOST_NODES = 40


def health(robot: RobotState, now: float) -> dict[str, Any]:
    """Return every node with its level, and every topic with its age [s] and the limit for it."""
    nodes = []
    for name, (at, told) in sorted(robot.nodes.items())[:MOST_NODES]:
        age = max(now - at, 0.0)
        nodes.append({
            'name': name, 'level': told['level'] if age < NODE_OLD else 'STALE',
            'message': told['message'], 'age': round(age, 1), 'values': told['values'],
        })  # fmt: skip
    inputs = [
        {'topic': topic, 'age': round(max(now - entry.at, 0.0), 1),
         'limit': OLD if topic in MEASURED else None}
        for topic, entry in sorted(robot.latest.items())
    ]  # fmt: skip
    return {'nodes': nodes, 'inputs': inputs}
