"""A topic as bytes for those who pass it on: all its publishers, and what they have latched.

A recorder must miss nothing and keeps a deep queue; a picture of now needs the newest of each
publisher. What comes between two looks is taken whole as long as it is not too much.
"""

from __future__ import annotations

from collections import OrderedDict
from typing import TYPE_CHECKING, Any, NamedTuple

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.exceptions import InvalidHandle

from agv_motion.bag.quality_of_service import kept
from agv_motion.ros.endpoints import matching, offered

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rclpy.node import Node
    from rclpy.topic_endpoint_info import TopicEndpointInfo

    from agv_motion.bag.quality_of_service import OfferedQos

DEPTH = 100
"""Messages that may come between two looks; the oldest of more are lost"""
SEEN = 200
"""messages that are remembered, where a topic is heard twice"""


class Terms(NamedTuple):
    """What a topic needs."""

    slots: int
    """messages that a picture of now consists of"""
    latched: bool
    """whether somebody's messages are kept for who comes late"""


def terms(publishers: Sequence[TopicEndpointInfo]) -> Terms:
    """Return what is needed to hear all publishers of a topic."""
    latched = kept(offered(publishers))
    return Terms(max(latched, len(publishers), 1), bool(latched))


class ChannelSubscription:
    """Subscriptions to one topic that hear each publisher on its own terms.

    Who asks for latched messages does not hear publishers that latch none, and who does not ask
    misses what was said before: where there are both, there are two subscriptions, and what comes
    by both is passed on once.
    """

    def __init__(self, node: Node, topic: str, kind: Any) -> None:
        """Prepare; subscriptions come with the publishers.

        Args:
            node: One that no executor takes from.
            topic: Full name.
            kind: Message class.

        """
        self._node, self._topic, self._kind = node, topic, kind
        self._open: dict[tuple[bool, bool, int], Any] = {}
        """by whether it is reliable, whether latched, and its depth"""
        self._seen: OrderedDict[tuple[int, int], None] = OrderedDict()

    def meet(self, publishers: Sequence[TopicEndpointInfo]) -> None:
        """Subscribe so that all ``publishers`` are heard; none that are gone count any more."""
        offers = offered(publishers)
        latched = [offer for offer in offers if offer.durability == 'transient_local']
        wanted = {}
        if len(latched) < len(offers):
            wanted[_key(offers, latched=False)] = offers
        if latched:
            wanted[_key(latched, latched=True)] = latched
        if not offers or wanted.keys() == self._open.keys():
            return
        before, self._open = self._open, {
            key: self._open.get(key) or self._subscribed(key, heard)
            for key, heard in wanted.items()
        }  # fmt: skip
        for key, subscription in before.items():
            if key not in wanted:
                self._node.destroy_subscription(subscription)

    def take(self) -> Iterator[tuple[bytes, int]]:
        """Yield data and time of arrival [ns] of what has come since the last time."""
        twice = len(self._open) > 1
        for subscription in list(self._open.values()):
            handle, kind = subscription.handle, self._kind
            try:
                with handle:
                    take = handle.take_message
                    for _ in range(DEPTH):
                        taken = take(kind, True)  # noqa: FBT003 - raw
                        if taken is None:
                            break
                        data, info = taken
                        if not twice or self._is_new(info):
                            yield data, info['received_timestamp']
            except InvalidHandle:
                continue  # it was closed meanwhile, in the thread of the node

    def close(self) -> None:
        """Hear no more."""
        closed, self._open = self._open, {}
        for subscription in closed.values():
            self._node.destroy_subscription(subscription)

    def _subscribed(self, key: tuple[bool, bool, int], offers: Sequence[OfferedQos]) -> Any:
        _, latched, depth = key
        profile = matching(offers, latched=latched)
        profile.depth = depth
        return self._node.create_subscription(
            self._kind, self._topic, _ignore, profile, raw=True,
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
        )  # fmt: skip

    def _is_new(self, info: dict[str, Any]) -> bool:
        key = info['source_timestamp'], info['publication_sequence_number']
        if key in self._seen:
            return False
        self._seen[key] = None
        if len(self._seen) > SEEN:
            self._seen.popitem(last=False)
        return True


def _key(offers: Sequence[OfferedQos], *, latched: bool) -> tuple[bool, bool, int]:
    reliable = all(offer.reliability == 'reliable' for offer in offers)
    return reliable, latched, max(DEPTH, kept(offers))


def _ignore(_: Any) -> None:
    """Stand where rclpy wants a callback."""
