"""The services that rclpy gives to every node: what they raise is answered and told, not fatal.

A lifecycle request that does not fit the state, or a parameter of a type that there is not, raises
in rclpy 7.1 out of the executor: the process would end by a request from anywhere, without a zero.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lifecycle_msgs.srv import ChangeState

from agv_motion.errors import shortened

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.lifecycle import LifecycleNode

    Refuse = Callable[[str], None]


def answer_all(node: LifecycleNode, refuse: Refuse) -> None:
    """Let every service that ``node`` has by now answer all requests; ``refuse`` tells why not."""
    for service in node.services:
        act = service.callback
        if service.srv_type is ChangeState:
            act = _fitting(node, act, refuse)
        service.callback = _answered(service.srv_name, act, refuse)


def _answered(name: str, act: Callable[[Any, Any], Any], refuse: Refuse) -> Any:
    """Return ``act``, which answers with an empty response where it raises."""

    def answer(request: Any, response: Any) -> Any:
        try:
            return act(request, response)
        except Exception as error:  # noqa: BLE001 - rclpy's own, of many kinds
            refuse(f'a request to {name}: {type(error).__name__}: {error}')
            return type(response)()

    return answer


def _fitting(node: LifecycleNode, act: Callable[[Any, Any], Any], refuse: Refuse) -> Any:
    """Return ``act`` for the transitions that start from the present state; refuse the others."""

    def change(request: Any, response: Any) -> Any:
        machine = node._state_machine  # noqa: SLF001 - rclpy has no other way to ask
        fitting = {id_: label for id_, label, *_ in machine.available_transitions}
        asked = request.transition
        if (asked.label or asked.id) in {*fitting, *fitting.values()}:
            return act(request, response)
        wanted = asked.label or NAMES.get(asked.id, f'transition {asked.id}')
        refuse(
            f"lifecycle: '{shortened(wanted)}' does not start from the state "
            f"'{machine.current_state[1]}'; from there start "
            f'{", ".join(sorted(set(fitting.values()))) or "none: start the node anew"}'
        )
        response.success = False
        return response

    return change


NAMES = {
    1: 'configure', 2: 'cleanup', 3: 'activate', 4: 'deactivate', 5: 'shutdown from unconfigured',
    6: 'shutdown from inactive', 7: 'shutdown from active',
}  # fmt: skip
"""Words for the transitions that a user asks for, by their number in lifecycle_msgs/Transition"""
