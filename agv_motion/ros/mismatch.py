"""Ends of one topic that never meet: other types, or terms that the publisher does not offer.

The middleware drops such messages without a word to either side.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.qos import DurabilityPolicy, LivelinessPolicy, ReliabilityPolicy

from agv_motion.ros.graph_ends import names

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rclpy.qos import QoSProfile
    from rclpy.topic_endpoint_info import TopicEndpointInfo

    from agv_motion.ros.graph_ends import OwnEnd

TWISTS = {'geometry_msgs/msg/Twist', 'geometry_msgs/msg/TwistStamped'}

FOREVER = 2**63 - 1
"""[ns]"""


def mismatches(own: OwnEnd, topic: str, others: Sequence[TopicEndpointInfo]) -> Iterator[str]:
    """Yield which of the other ends do not meet the own one, and what to do about it.

    Args:
        own: The node's end.
        topic: Its full name.
        others: Listeners of the topic if the node publishes it, else its publishers.

    """
    for other in others:
        if other.topic_type != own.kind:
            yield f'{topic}: {_other_type(own, other)}'
            continue
        mine, its = own.qos, other.qos_profile
        unmet = _unmet(mine, its) if own.publishes else _unmet(its, mine)
        if unmet:
            wanted, given = unmet
            way, remedy = (
                ('to', f'subscribe {given}') if own.publishes else ('from', f'publish {wanted}')
            )
            yield (
                f'{topic}: nothing gets through {way} {names([other])}, as {wanted} is asked for '
                f'and {given} offered; let it {remedy}'
            )


def _unmet(offered: QoSProfile, asked: QoSProfile) -> tuple[str, str] | None:
    """Return what is asked for in vain, and what is offered instead; None if the two meet."""
    if (asked.reliability, offered.reliability) == (
        ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT,
    ):  # fmt: skip
        return 'reliable', 'best effort'
    if (asked.durability, offered.durability) == (
        DurabilityPolicy.TRANSIENT_LOCAL, DurabilityPolicy.VOLATILE,
    ):  # fmt: skip
        return 'transient local', 'volatile'
    if (asked.liveliness, offered.liveliness) == (
        LivelinessPolicy.MANUAL_BY_TOPIC, LivelinessPolicy.AUTOMATIC,
    ):  # fmt: skip
        return 'liveliness by topic', 'automatic liveliness'
    for name, wanted, given in (
        ('deadline', asked.deadline, offered.deadline),
        ('lease', asked.liveliness_lease_duration, offered.liveliness_lease_duration),
    ):
        if (given.nanoseconds or FOREVER) > (wanted.nanoseconds or FOREVER):
            return f'a {name} of {wanted.nanoseconds * 1e-9:g} s', 'a longer one'
    return None


def _other_type(own: OwnEnd, other: TopicEndpointInfo) -> str:
    kind = other.topic_type
    it, this = ('expects', 'publishes') if own.publishes else ('publishes', 'expects')
    remedy = 'give both the same type, or remap one of them'
    if {kind, own.kind} == TWISTS:
        stamped = str(kind.endswith('TwistStamped')).lower()
        remedy = f'set stamped:={stamped} at this node, or let the other use {own.kind}'
    return (
        f'{names([other])} {it} {kind}, this node {this} {own.kind}, so nothing gets through; '
        f'{remedy}'
    )
