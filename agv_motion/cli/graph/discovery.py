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

DISCOVERY = 0.5
"""[s] How long to listen to the graph before telling what is there, as `ros2` does,"""

SETTLED, BRIEF = 0.2, 0.1
"""[s] ... and on until nothing new has come for so long; where no end's number is left out, less"""

LONGEST = 10.0
"""[s] but no longer than this in all: somebody is here who does not answer,"""

DOUBTFUL = 4.0
"""[s] or than this where all have been heard and something does not go together,"""

ALONE = 1.5
"""[s] or than this where nobody was heard, who may be on another machine."""

CALLS = 0.1, 0.3, 0.9, 2.7
"""[s] How long after the start all are called who may not have been heard"""

LOOK, EXAMINE = 0.01, 0.04
"""[s] between two looks whether it is enough, and between two at all ends: those cost 5 to 20 ms"""

STRANGE = '_NODE_NAME_UNKNOWN_', '_CREATED_BY_BARE_DDS_APP_'
"""What stands for the name of a node that is not known yet"""


def settle(node: Any, spin_time: float, until: Callable[[], bool] = lambda: False) -> None:
    """Spin ``node`` for ``spin_time`` [s] and on until all are heard; or until ``until()``.

    Where all who can be heard are on this machine they are counted, and `DISCOVERY` is not
    waited for. Who is missing is called.
    """
    import rclpy

    start = changed = due = time.monotonic()
    calls = list(CALLS)
    domain = node.context.get_domain_id()
    counted = are_all_on_this_machine(domain)
    if spin_time <= DISCOVERY and counted:
        spin_time = 0.0
    known: Ends | None = None
    while not until():
        rclpy.spin_once(node, timeout_sec=LOOK)
        now = time.monotonic()
        if now < due:
            continue
        found = ends_of(node)
        if found != known:
            known, changed = found, now
        if now - start >= spin_time and _is_enough(node, found, now - changed, now - start):
            return
        if calls and now - start >= calls[0] and (missing(node, found) or not counted):
            call(domain)
            del calls[0]
        due = time.monotonic() + EXAMINE


def call(domain: int) -> None:
    """Let all participants of a domain tell of themselves once more: somebody comes, and goes.

    A participant of Fast DDS announces itself before it listens. An answer that is quicker than
    that is lost, and the others think that they have answered: they speak again in up to three
    seconds. But each answers whoever is new, and so that all on its machine can hear it.
    """
    import rclpy
    from rclpy.parameter import Parameter
    from rclpy.signals import SignalHandlerOptions

    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain, signal_handler_options=SignalHandlerOptions.NO)
    rclpy.create_node(
        f'_agv_call_{os.getpid()}',
        context=context,
        enable_rosout=False,
        start_parameter_services=False,
        parameter_overrides=[Parameter('start_type_description_service', value=False)],
    ).destroy_node()
    context.shutdown()


def _is_enough(node: Any, ends: Ends, calm: float, listened: float) -> bool:
    """Return whether nothing more is to be expected after a time [s] without news."""
    if missing(node, ends):
        return listened >= LONGEST
    if is_alone(node):
        return listened >= ALONE
    if not whole(ends):
        return listened >= DOUBTFUL
    return calm >= (BRIEF if is_gapless(ends) else SETTLED)


def is_alone(node: Any) -> bool:
    """Return whether nobody was heard, and others may be where this machine's ports do not tell."""
    if are_all_on_this_machine(node.context.get_domain_id()):
        return False
    return len(node.get_node_names()) < 2


def is_gapless(ends: Ends) -> bool:
    """Return whether each participant's ends bear the numbers from 1 on, as Fast DDS deals them.

    What has been closed again leaves a gap too, which no waiting fills.
    """
    numbers: dict[bytes, set[int]] = {}
    for _, identity, *_ in ends:
        numbers.setdefault(identity[:PREFIX], set()).add(int.from_bytes(identity[PREFIX:-1], 'big'))
    return all(max(dealt) == len(dealt) for dealt in numbers.values())


def whole(ends: Ends) -> bool:
    """Return whether ends go together: nothing is told of one half that lacks the other."""
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
