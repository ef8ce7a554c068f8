"""What a node does about others on its topics: falls silent beside a rival, and tells of the rest.

Two motion generators, kinematics or localizations on one robot pull it two ways. Each sees the
other, deactivates itself with its outputs safe, and goes on when it is alone again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from agv_motion.ros.graph_watch import GraphWatch

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from rclpy.lifecycle import LifecycleNode
    from rclpy.qos import QoSProfile


LOOKS_AROUND = 5
"""Looks at the graph after which those that are there have been found, and a healthy node says what
it needs and what it makes of it."""

PATIENCE = 25
"""Looks after which it says what it still lacks: nodes that are started together come one by one,
on a busy machine in some seconds."""

PAST_THE_ARBITER = '; where there is an arbiter, remap all others to cmd_vel/agent or the like'
"""What to do about those who drive past it."""


class StandingWarnings:
    """What is not as it should be, told when that begins, and again when it has been away."""

    def __init__(self, warn: Callable[[str], None]) -> None:
        """Have told nothing; ``warn`` tells."""
        self._warn = warn
        self._told: frozenset[str] = frozenset()

    def update(self, texts: Iterable[str]) -> None:
        """Take all that is so now."""
        now = frozenset(texts)
        for text in sorted(now - self._told):
            self._warn(text)
        self._told = now


class GraphGuard:
    """Watches the topics of one node, and acts upon what it finds."""

    def __init__(
        self, node: LifecycleNode, is_active: Callable[[], bool], warn: Callable[[str], None]
    ) -> None:
        """Watch nothing yet.

        Args:
            node: Of rclpy.
            is_active: Whether it acts.
            warn: Tells of what is not as it should be.

        """
        self.rivals = ''
        """Who publishes together what one node may alone; empty if it does."""
        self._node, self._watch = node, GraphWatch(node)
        self._is_active, self._warnings = is_active, StandingWarnings(warn)
        self._rests = False
        self._looks: int | None = None
        """Looks at the graph since the node wanted to say how it is; None: it has."""

    def add(
        self, kind: type[Any], topic: str, qos: QoSProfile, *, publishes: bool, sole: bool
    ) -> None:
        """Watch a topic of the node from now on."""
        self._watch.add(kind, topic, qos, publishes=publishes, sole=sole)

    def need(self, *topics: str) -> None:
        """Know that the node can do nothing where nobody publishes ``topics``."""
        self._watch.needed.extend(topics)

    def clear(self) -> None:
        """Watch nothing any more."""
        self._watch.clear()
        self.rivals, self._rests = '', False

    def introduce(self) -> None:
        """Say in a while what the node needs and makes; before that, what it needs and lacks."""
        self._looks = 0

    def check(self) -> None:
        """Look at the graph; deactivate the node beside a rival, activate it when that is gone."""
        node = self._node
        self.rivals = self._watch.look()
        if self.rivals and self._is_active():
            node.get_logger().error(
                f'stopped: {self.rivals}: stop all but one, or give each robot a namespace (one '
                'that was killed stays on the graph for up to 20 s); then this node goes on'
            )
            self._rests = True
            node.trigger_deactivate()
        elif self._rests and not self.rivals:
            self._rests = False
            node.get_logger().info('alone on its topics again: going on')
            node.trigger_activate()
        self._tell()
        if self._looks is not None and self._is_active():
            self._introduce(self._looks + 1)

    def faults(self) -> tuple[str, ...]:
        """Return what keeps ends from meeting, and what to do about it."""
        return self._watch.faults()

    def values(self) -> dict[str, str]:
        """Return what there is to know for the diagnostics."""
        crowds = {f'publishers of {topic}': who for topic, who in self._watch.crowds().items()}
        return crowds | {f'graph {i + 1}': fault for i, fault in enumerate(self.faults())}

    def _introduce(self, looks: int) -> None:
        """Say at a look that the node has all it needs, or once after a while what it lacks."""
        self._looks = looks
        missing = self._watch.missing() if looks >= LOOKS_AROUND else ''
        if missing and looks == PATIENCE:
            self._node.get_logger().warning(f'active, but nobody publishes {missing} yet')
        if looks >= LOOKS_AROUND and not missing:
            self._looks = None
            self._node.get_logger().info(self._watch.introduction())

    def _tell(self) -> None:
        """Log what is new."""
        crowds = {
            f'{who} all publish {topic}: let one of them at a time, or all are obeyed in turn'
            + PAST_THE_ARBITER * (topic == 'cmd_vel')
            for topic, who in self._watch.crowds().items()
        }
        self._warnings.update((*self.faults(), *crowds))
