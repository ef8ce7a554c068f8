"""Hear everything that is said on topics, as bytes, whatever terms their publishers offer.

Messages are taken many at a time rather than by a callback each: the middleware has stamped them at
their arrival, an executor costs more than the message, and EventsExecutor (rclpy 7.1) fails on
callbacks that ask for times and numbers.
"""

from __future__ import annotations

from collections import OrderedDict
from typing import TYPE_CHECKING, Any

from rclpy.context import Context
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node

from agv_motion.ros.context import begin_context
from agv_motion.ros.endpoints import DEEP, matching, offered

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rclpy.topic_endpoint_info import TopicEndpointInfo

    from agv_motion.bag.quality_of_service import OfferedQos

    Take = Callable[[bytes, dict[str, Any]], None]


class ListenerNodes:
    """Hidden nodes for subscriptions that no executor takes from.

    A participant of the middleware knows one type of a topic only; a topic of several types needs
    as many participants, each with a context of its own.
    """

    def __init__(self, name: str, context: Context) -> None:
        """Join the graph.

        Args:
            name: Of the node for which is listened.
            context: Its own.

        """
        self._name, self._context = name, context
        self._others: list[Context] = []
        self._nodes = [self._node(context)]

    def node(self, number: int) -> Node:
        """Return the node for the type of this ``number``, from 0, of a topic."""
        while len(self._nodes) <= number:
            other = Context()
            begin_context(context=other, domain_id=self._context.get_domain_id())
            self._others.append(other)
            self._nodes.append(self._node(other))
        return self._nodes[number]

    def close(self) -> None:
        """Leave the graph."""
        for node in self._nodes:
            node.destroy_node()
        for context in self._others:
            context.try_shutdown()

    def _node(self, context: Context) -> Node:
        return Node(
            f'_{self._name}_listener',
            context=context,
            start_parameter_services=False,
            enable_rosout=False,
            use_global_arguments=False,
        )


class RawSubscription:
    """Subscriptions to one topic, which ask for no more than its publishers offer.

    A subscription that asks for reliable or latched messages does not hear publishers that offer
    less; one that asks for less misses what latched publishers sent before. So there are as many
    as it takes, and what comes twice is passed on once. None is ever closed before the end, as
    messages would be lost meanwhile.
    """

    def __init__(self, node: Node, topic: str, kind: Any, take: Take) -> None:
        """Prepare; subscriptions come with the publishers.

        Args:
            node: One of :class:`ListenerNodes`.
            topic: Full name.
            kind: Message class.
            take: Called with each message in CDR and rclpy's message info.

        """
        self._node, self._topic, self._kind, self._take = node, topic, kind, take
        self._offers: dict[tuple[int, ...], OfferedQos] = {}
        self._subscriptions: dict[tuple[bool, bool], Any] = {}
        self._seen: OrderedDict[tuple[int, int], None] = OrderedDict()

    @property
    def publishers(self) -> int:
        """Number of publishers that were ever seen."""
        return len(self._offers)

    def meet(self, publishers: Sequence[TopicEndpointInfo]) -> bool:
        """Subscribe so that all ``publishers`` are heard; return whether there are new ones."""
        new = [one for one in publishers if tuple(one.endpoint_gid) not in self._offers]
        for one, offer in zip(new, offered(new), strict=True):
            self._offers[tuple(one.endpoint_gid)] = offer
        offers = list(self._offers.values())
        latched = [offer for offer in offers if offer.durability == 'transient_local']
        if len(latched) < len(offers):
            self._subscribe(offers, latched=False)
        if latched:
            self._subscribe(latched, latched=True)
        return bool(new)

    def take(self) -> None:
        """Pass on what has come since the last time."""
        for subscription in self._subscriptions.values():
            handle = subscription.handle
            with handle:
                for _ in range(DEEP):
                    taken = handle.take_message(self._kind, True)  # noqa: FBT003 - raw
                    if taken is None:
                        break
                    self._hear(*taken)

    def close(self) -> None:
        """Hear no more."""
        for subscription in self._subscriptions.values():
            self._node.destroy_subscription(subscription)
        self._subscriptions.clear()

    def _subscribe(self, offers: Sequence[OfferedQos], *, latched: bool) -> None:
        terms = all(offer.reliability == 'reliable' for offer in offers), latched
        if terms not in self._subscriptions:
            self._subscriptions[terms] = self._node.create_subscription(
                self._kind, self._topic, _ignore, matching(offers, latched=latched), raw=True,
                event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
            )  # fmt: skip

    def _hear(self, data: bytes, info: dict[str, Any]) -> None:
        seen = self._seen
        key = info['source_timestamp'], info['publication_sequence_number']
        if key in seen and len(self._subscriptions) > 1:
            return
        seen[key] = None
        if len(seen) > DEEP:
            seen.popitem(last=False)
        self._take(data, info)


def _ignore(_: Any) -> None:
    """Stand where rclpy wants a callback."""
