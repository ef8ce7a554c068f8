"""The lifecycle of other nodes, by the services that nodes with one have."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lifecycle_msgs.srv import ChangeState, GetAvailableTransitions, GetState

from agv_motion.ros.remote_services import PATIENCE, UnansweredError, call, call_all

if TYPE_CHECKING:
    from collections.abc import Iterable

    from lifecycle_msgs.msg import Transition, TransitionDescription

LONG = 30.0
"""[s] that a transition may take: the wheels come to rest, files are read"""


def states(node: Any, names: Iterable[str], patience: float = PATIENCE) -> dict[str, Any]:
    """Return the state of each node (`lifecycle_msgs/State`), or the error in its place.

    Args:
        node: Of rclpy, that asks.
        names: Full names of nodes with a lifecycle.
        patience: How long to wait for all [s].

    """
    services = {f'{name}/get_state': name for name in names}
    requests = {service: GetState.Request() for service in services}
    answers = call_all(node, GetState, requests, patience)
    return {
        services[service]: answer if isinstance(answer, UnansweredError) else answer.current_state
        for service, answer in answers.items()
    }


def transitions(node: Any, name: str, *, every: bool = False) -> list[TransitionDescription]:
    """Return the transitions that start from a node's present state, or ``every`` one.

    Raises:
        UnansweredError: The node does not answer.

    """
    service = 'get_transition_graph' if every else 'get_available_transitions'
    request = GetAvailableTransitions.Request()
    answer = call(node, GetAvailableTransitions, f'{name}/{service}', request)
    return list(answer.available_transitions)


def change(node: Any, name: str, transition: Transition) -> bool:
    """Let a node change its state; return whether it has.

    Raises:
        UnansweredError: The node does not answer.

    """
    request = ChangeState.Request(transition=transition)
    return bool(call(node, ChangeState, f'{name}/change_state', request, LONG).success)
