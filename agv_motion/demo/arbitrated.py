"""The arbiter of a demo, and what is recorded of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import TwistStamped
from std_msgs.msg import Bool

from agv_motion.arbitration.source import TwistSource
from agv_motion.demo.configured import configured_node
from agv_motion.demo.recorder import RecordedTopic
from agv_motion.nodes.arbiter import ArbiterNode

if TYPE_CHECKING:
    from agv_motion.ros.live_node import LiveNode

TOPICS = (
    *(RecordedTopic(f'cmd_vel/{source.value}', TwistStamped) for source in TwistSource),
    RecordedTopic('cmd_vel', TwistStamped),
    RecordedTopic('driver', DiagnosticStatus, latched=True),
    RecordedTopic('standstill', Bool, latched=True),
)


def drives_as(source: TwistSource) -> dict[str, list[str]]:
    """Return the arguments of a node whose twists go to the arbiter as those of ``source``."""
    return {'cli_args': ['--ros-args', '-r', f'cmd_vel:=cmd_vel/{source.value}']}


def arbiter_node(file: str, changes: dict[str, Any], namespace: str = '') -> LiveNode[ArbiterNode]:
    """Return an arbiter with its values in ``file`` of config/, then ``changes``.

    A demo keeps no STOP for the next one.

    Args:
        file: Of the configuration.
        changes: Of parameters, by name.
        namespace: Of the robot; empty for none.

    """
    more = {'namespace': namespace} if namespace else {}
    common = {'use_sim_time': True}
    return configured_node(ArbiterNode, file, common | changes, **more)
