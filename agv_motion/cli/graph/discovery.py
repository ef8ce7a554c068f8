"""When enough of the ROS graph has been heard to say what is on it.

What is known of a participant comes in bursts, by several ways, and a list made between two of them
lacks something and does not look so. But each participant of ROS says of what it consists: whoever
is here has been heard when all is known that they name. No time need be waited in which surely all
must have come.
"""

from __future__ import annotations

import os
import time
from typing import TYPE_CHECKING, Any

from agv_motion.cli.graph.participant_entities import ParticipantEntities
from agv_motion.cli.graph.participants import (
    GRAPH_TOPIC,
    PREFIX,
    Ends,
    are_all_on_this_machine,
    ends_of,
    missing,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.cli.graph.participant_entities import Told

DISCOVERY = 0.5
"""[s] How long to listen to the graph before telling what is there, as `ros2` does,"""

SETTLED = 0.2
"""[s] ... and on until nothing new has come for so long, where somebody does not say what it is,"""

LONGEST = 10.0
"""[s] but no longer than this in all: somebody is here who does not answer,"""

ALONE = 1.5
"""[s] or than this where nobody was heard, who may be on another machine."""

CALLS = 0.1, 0.3, 0.9, 2.7
"""[s] How long after the start all are called who may not have been heard"""

FIRST, EXAMINE, LATER = 0.01, 0.04, 0.1
"""[s] until the first look at all ends, between two, which cost 5 to 20 ms, and after a second"""


def settle(node: Any, spin_time: float, until: Callable[[], bool] = lambda: False) -> int:
    """Spin ``node`` for ``spin_time`` [s] and on until all are heard; or until ``until()``.

    Where all who can be heard are on this machine they are counted, and `DISCOVERY` is not
    waited for. Who is missing is called. Returns how many could not be heard out.
    """
    import rclpy

    start = changed = time.monotonic()
    due = start + FIRST
    calls = list(CALLS)
    domain = node.context.get_domain_id()
    counted = are_all_on_this_machine(domain)
    if spin_time <= DISCOVERY and counted:
        spin_time = 0.0
    known: Ends | None = None
    with ParticipantEntities(node) as graph:
        while not until():
            rclpy.spin_once(node, timeout_sec=max(due - time.monotonic(), 0.001))
            now = time.monotonic()
            if now < due:
                continue
            told = graph.told()  # before the ends: what is told of is known soon after
            found = ends_of(node)
            if found != known:
                known, changed = found, now
            listened, calm = now - start, now - changed
            unheard = missing(node, found) + len(unfinished(found, told))
            if told is not None and not strangers(found):
                calm = SETTLED  # who says of what it consists has no need of it
            if listened >= spin_time and _is_enough(node, unheard, calm, listened):
                return unheard
            if calls and listened >= calls[0] and (missing(node, found) or not counted):
                call(domain)
                del calls[0]
            due = time.monotonic() + (EXAMINE if listened < 1.0 else LATER)
    return 0


def call(domain: int) -> None:
    """Let all participants of a domain tell of themselves once more: somebody comes, and goes.

    A participant of Fast DDS announces itself before it listens. An answer that is quicker than
    that is lost, and the others think that they have answered: they speak again in up to three
    seconds. But each answers whoever is new, and so that all on its machine can hear it.
    """
    import rclpy
    from rclpy.parameter import Parameter

    from agv_motion.ros.context import begin_context

    context = rclpy.Context()
    begin_context(context=context, domain_id=domain)
    rclpy.create_node(
        f'_agv_call_{os.getpid()}',
        context=context,
        enable_rosout=False,
        start_parameter_services=False,
        parameter_overrides=[Parameter('start_type_description_service', value=False)],
    ).destroy_node()
    context.shutdown()


def _is_enough(node: Any, unheard: int, calm: float, listened: float) -> bool:
    """Return whether nothing more is to be expected after a time [s] without news."""
    if unheard:
        return listened >= LONGEST
    if is_alone(node):
        return listened >= ALONE
    return calm >= SETTLED


def is_alone(node: Any) -> bool:
    """Return whether nobody was heard, and others may be where this machine's ports do not tell."""
    if are_all_on_this_machine(node.context.get_domain_id()):
        return False
    return len(node.get_node_names()) < 2


def unfinished(ends: Ends, told: Told | None) -> set[bytes]:
    """Return the participants of ROS of which less is known than they say, or that said nothing."""
    if told is None:
        return set()
    known = {(identity, name) for _, identity, _, name in ends}
    return {one for one in _of_ros(ends) if one not in told or not told[one] <= known}


def strangers(ends: Ends) -> set[bytes]:
    """Return the participants that do not say of what they consist: what is no ROS."""
    return {identity[:PREFIX] for _, identity, *_ in ends} - _of_ros(ends)


def _of_ros(ends: Ends) -> set[bytes]:
    """Return the participants that have the graph's topic: their first end, known before others."""
    return {identity[:PREFIX] for topic, identity, *_ in ends if topic == GRAPH_TOPIC}
