"""How the nodes of a robot were wired when a bag was recorded: through an arbiter, or not."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.arbitration.source import RANKED, TwistSource
from agv_motion.errors import ConfigurationError
from agv_motion.ros.in_process_port import full_name

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

ARBITER = 'arbiter'

DRIVES_AS = {
    'motion_generator': TwistSource.AGENT,
    'ghost_trajectory': TwistSource.PAGE,
    'route_follower': TwistSource.ROUTE,
    'sequence': TwistSource.SEQUENCE,
}
"""As which source each node speaks to an arbiter, in the launch files and the demos."""


def has_arbiter(topics: Collection[str], namespace: str) -> bool:
    """Return whether the robot in ``namespace`` had an arbiter, by the topics of its bag."""
    return any(full_name(f'cmd_vel/{source.value}', namespace) in topics for source in RANKED)


def nodes_for(nodes: tuple[str, ...], topics: Collection[str], namespace: str) -> tuple[str, ...]:
    """Return which of ``nodes`` to run over a bag: no arbiter where there was none.

    Raises:
        ConfigurationError: None is left.

    """
    left = nodes
    if not has_arbiter(topics, namespace):
        left = tuple(name for name in nodes if name != ARBITER)
    if not left:
        where = full_name('cmd_vel', namespace)
        msg = f'the bag has no {where}/agent, /manual ...: it was recorded without an arbiter'
        raise ConfigurationError(msg)
    return left


def names_for(
    node: str, topics: Collection[str], namespace: str, given: Mapping[str, str]
) -> Mapping[str, str]:
    """Return the remapping of a node: that which is given, and `cmd_vel` to what it drove as.

    Args:
        node: Its name.
        topics: Of the bag.
        namespace: Of the robot.
        given: Full names of topics, by the full names that the node uses; they come first.

    """
    own = full_name('cmd_vel', namespace)
    if node not in DRIVES_AS or own in given or not has_arbiter(topics, namespace):
        return given
    return {**given, own: full_name(f'cmd_vel/{DRIVES_AS[node].value}', namespace)}
