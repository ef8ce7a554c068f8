"""The node `why` of each robot of a demo, and what is recorded of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from diagnostic_msgs.msg import DiagnosticArray
from std_msgs.msg import String

from agv_motion.demo.recorder import RecordedTopic
from agv_motion.explanation.wheels import DRIVERS
from agv_motion.nodes.why import Why
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.run import overrides

if TYPE_CHECKING:
    from collections.abc import Iterable

TOLD = (('why', DiagnosticArray), ('zone', String))
"""Latched topics of each robot, and their types"""


def robots(nodes: Iterable[LiveNode[Any]]) -> list[str]:
    """Return the namespaces of the robots that have wheels."""
    return sorted({node.get_namespace() for node in nodes if node.get_name() in DRIVERS})


def why_nodes(namespaces: Iterable[str]) -> list[LiveNode[Why]]:
    """Return a node `why` in each namespace."""
    return [
        LiveNode(
            Why,
            cli_args=['--ros-args', '-r', f'__ns:={namespace}'],
            parameter_overrides=overrides(use_sim_time=True),
        )
        for namespace in namespaces
    ]


def why_topics(namespaces: Iterable[str]) -> list[RecordedTopic]:
    """Return what is recorded of each robot."""
    return [
        RecordedTopic(f'{namespace.strip("/")}/{topic}'.strip('/'), kind, latched=True)
        for namespace in namespaces
        for topic, kind in TOLD
    ]
