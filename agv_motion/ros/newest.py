"""The newest message of a topic, as bytes, whatever its rate: nothing waits, nothing is decoded.

The middleware keeps one message; whoever looks takes it. A robot that speaks a thousand times a
second costs no more than one that speaks ten times.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rclpy.node import Node
    from rclpy.topic_endpoint_info import TopicEndpointInfo


class NewestSubscription:
    """Subscribes to one topic with the weakest terms of its publishers, and keeps the newest."""

    def __init__(self, node: Node, topic: str, kind: Any, depth: int = 1) -> None:
        """Prepare; the subscription comes with the publishers.

        Args:
            node: One that no executor takes from.
            topic: Full name.
            kind: Message class.
            depth: Messages that are kept: more than one where many publishers speak on the topic.

        """
        self._node, self._topic, self._kind, self._depth = node, topic, kind, depth
        self._terms: tuple[bool, bool] | None = None
        self._subscription: Any = None

    def meet(self, publishers: Sequence[TopicEndpointInfo]) -> None:
        """Subscribe so that all ``publishers`` are heard; none that are gone count any more."""
        profiles = [one.qos_profile for one in publishers]
        if not profiles:
            return
        terms = (
            all(qos.reliability is ReliabilityPolicy.RELIABLE for qos in profiles),
            all(qos.durability is DurabilityPolicy.TRANSIENT_LOCAL for qos in profiles),
        )
        if terms == self._terms:
            return
        self.close()
        reliable, latched = terms
        self._terms = terms
        self._subscription = self._node.create_subscription(
            self._kind, self._topic, _ignore,
            QoSProfile(
                depth=self._depth,
                reliability=ReliabilityPolicy.RELIABLE if reliable
                else ReliabilityPolicy.BEST_EFFORT,
                durability=DurabilityPolicy.TRANSIENT_LOCAL if latched
                else DurabilityPolicy.VOLATILE,
            ),
            raw=True, event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
        )  # fmt: skip

    def take(self) -> Iterator[bytes]:
        """Yield what has come since the last time, oldest first."""
        if self._subscription is None:
            return
        handle = self._subscription.handle
        with handle:
            for _ in range(self._depth):
                taken = handle.take_message(self._kind, True)  # noqa: FBT003 - raw
                if taken is None:
                    return
                yield taken[0]

    def close(self) -> None:
        """Hear no more."""
        if self._subscription is not None:
            self._node.destroy_subscription(self._subscription)
        self._subscription = self._terms = None


def _ignore(_: Any) -> None:
    """Stand where rclpy wants a callback."""
