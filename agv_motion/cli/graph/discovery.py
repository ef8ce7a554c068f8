"""When enough of the ROS graph has been heard to say what is on it.

What is known of a participant comes in bursts: its name, its publishers, its subscriptions, and by
another way the names of its nodes. A list made between two of them lacks something, and does not
look so. Here it is told by what must go together: each participant of ROS writes and reads the
graph's own topic, each server of a service reads requests and writes responses, each end belongs to
a node. So an answer need not wait for a time in which surely all must have come.
"""

from __future__ import annotations

import os
import time
from collections import Counter
from typing import TYPE_CHECKING, Any

from agv_motion.cli.graph.participants import PREFIX, missing, on_this_machine

if TYPE_CHECKING:
    from collections.abc import Callable

DISCOVERY = 0.5
"""[s] How long to listen to the graph before telling what is there, as `ros2` does."""

SETTLED = 0.2
"""[s] ... and on until nothing new has come for so long,"""

LONGEST = 10.0
"""[s] but no longer than this in all: somebody is here who does not answer,"""

DOUBTFUL = 4.0
"""[s] or than this where all have been heard and something does not go together,"""

ALONE = 1.5
"""[s] or than this where nobody was heard: those of other machines are told five times in half a
second that somebody has come, and answer each time."""

LOOK, EXAMINE = 0.02, 0.1
"""[s] between two looks whether it is enough, and between two at all ends: those cost 5 to 20 ms"""

GRAPH_TOPIC = 'ros_discovery_info'
"""Of every participant of ROS 2: which ends belong to which of its nodes"""

STRANGE = '_NODE_NAME_UNKNOWN_', '_CREATED_BY_BARE_DDS_APP_'
"""What stands for the name of a node that is not known yet"""


def settle(node: Any, spin_time: float, until: Callable[[], bool] = lambda: False) -> None:
    """Spin ``node`` for ``spin_time`` [s] and on until all are heard; or until ``until()``."""
    import rclpy

    start = changed = time.monotonic()
    known: Any = None
    due = start
    while not until():
        rclpy.spin_once(node, timeout_sec=LOOK)
        now = time.monotonic()
        if now < due:
            continue
        due = now + EXAMINE
        found = ends_of(node)
        if found != known:
            known, changed = found, now
        if now - start >= spin_time and (
            (now - changed >= SETTLED and heard_all(node))
            or now - start >= max(_longest(node), spin_time)
        ):
            return


def heard_all(node: Any) -> bool:
    """Return whether nobody can be there of whom something is not known."""
    return not missing(node) and not is_alone(node) and whole(ends_of(node))


def _longest(node: Any) -> float:
    if missing(node):
        return LONGEST
    return ALONE if is_alone(node) else DOUBTFUL


def is_alone(node: Any) -> bool:
    """Return whether nobody was heard, and others may be where this machine's ports do not tell."""
    local = os.environ.get('ROS_AUTOMATIC_DISCOVERY_RANGE', '').upper() in {'LOCALHOST', 'OFF'}
    if local and on_this_machine(node.context.get_domain_id()):
        return False
    return len(node.get_node_names()) < 2


def ends_of(node: Any) -> frozenset[tuple[str, bytes, bool, str]]:
    """Return all ends that are known: DDS topic, identity, whether it writes, name of its node."""
    return frozenset(
        (topic, bytes(end.endpoint_gid), writes, end.node_name)
        for topic, _ in node.get_topic_names_and_types(no_demangle=True)
        for writes, ends in (
            (True, node.get_publishers_info_by_topic(topic, no_mangle=True)),
            (False, node.get_subscriptions_info_by_topic(topic, no_mangle=True)),
        )
        for end in ends
    )


def whole(ends: frozenset[tuple[str, bytes, bool, str]]) -> bool:
    """Return whether ends go together: nothing is told of one half that lacks the other.

    Args:
        ends: Of each the topic of DDS, the identity, whether it writes, and the name of its node.

    """
    of_ros: dict[bool, set[bytes]] = {True: set(), False: set()}
    halves: dict[str, Counter[tuple[str, bytes, bool]]] = {'rq': Counter(), 'rr': Counter()}
    strangers: set[bytes] = set()
    for topic, identity, writes, name in ends:
        kind, _, service = topic.partition('/')
        participant = identity[:PREFIX]
        if topic == GRAPH_TOPIC:
            of_ros[writes].add(participant)
        elif kind in halves:  # a server reads requests and writes responses, a client the reverse
            serves = writes is (kind == 'rr')
            service = service.removesuffix('Reply' if kind == 'rr' else 'Request')
            halves[kind][service, participant, serves] += 1
        if name in STRANGE and kind in {'rt', *halves}:
            strangers.add(participant)
    return (
        of_ros[True] == of_ros[False]
        and halves['rq'] == halves['rr']
        and not strangers & of_ros[True]
    )
