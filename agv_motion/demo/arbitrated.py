"""The arbiter of a demo, and what is recorded of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import TwistStamped
from std_msgs.msg import Bool

from agv_motion.arbitration import TwistSource
from agv_motion.arbitration.sentence import told
from agv_motion.demo.configured import configured_node
from agv_motion.demo.recorder import RecordedTopic
from agv_motion.nodes.arbiter import ArbiterNode

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

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


def arbiter_node(
    file: str, state: Path | None, changes: dict[str, Any], namespace: str = ''
) -> LiveNode[ArbiterNode]:
    """Return an arbiter with its values in ``file`` of config/, then ``changes``.

    Args:
        file: Of the configuration.
        state: Folder in which STOP and locks outlast the demo; None: nowhere.
        changes: Of parameters, by name.
        namespace: Of the robot; empty for none.

    """
    name = f'arbiter_{namespace}.json' if namespace else 'arbiter.json'
    kept = {} if state is None else {'state_file': str(state / name)}
    more = {'namespace': namespace} if namespace else {}
    common = {'use_sim_time': True}
    return configured_node(ArbiterNode, file, common | kept | changes, **more)


def held(nodes: Iterable[LiveNode[Any]]) -> Iterator[str]:
    """Yield what holds robots from an earlier demo, in words, and what to do about it."""
    for node in nodes:
        plain = node.plain
        if isinstance(plain, ArbiterNode) and (stop := plain.hold.stop) is not None:
            name, file = node.get_fully_qualified_name(), plain.parameters.state_file
            yield (
                f'STOP holds: {told(stop)}: release it by {name}/stop with data: false, or delete '
                f'{file} before the demo'
            )
