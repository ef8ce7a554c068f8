"""The chain of reasons of one robot, again and again: it remembers since when each link is so."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.explanation.command import command_link
from agv_motion.explanation.decision import decision_link
from agv_motion.explanation.link import Chain, Level, Link, way, worst
from agv_motion.explanation.pose import pose_link
from agv_motion.explanation.sap import sap_links
from agv_motion.explanation.wheels import DRIVERS, STILL, look, wheels_link

if TYPE_CHECKING:
    from agv_motion.explanation.evidence import Evidence


class Explainer:
    """Makes chains of the evidence of one robot."""

    def __init__(self) -> None:
        """Know of no time before."""
        self._known: dict[str, tuple[tuple[Level, str], float]] = {}
        self._told_to_turn: float | None = None

    def explain(self, evidence: Evidence, now: float, time: float) -> Chain:
        """Return the chain as it is now.

        Args:
            evidence: What is known of the robot.
            now: By the clock of whoever hears it, which never leaps [s].
            time: By the robot's clock [s since 1970].

        """
        time_zone = 'UTC'
        if (report := evidence.nodes.get('motion_generator')) is not None:
            time_zone = report.values.get('time zone', time_zone)
        driver = evidence.driver
        source = '' if driver is None else driver.values.get('driver', '')
        links = tuple(
            self._dated(link, time)
            for link in (
                wheels_link(evidence, now, self._ignored(evidence, now)),
                command_link(evidence, now),
                decision_link(evidence, now, source),
                pose_link(evidence, now),
                *sap_links(evidence, now, time, time_zone),
            )
        )
        return chained(links)

    def _ignored(self, evidence: Evidence, now: float) -> float:
        """Return for how long the wheels have stood though told to turn [s]."""
        found = evidence.first(DRIVERS)
        seen = None if found is None else look(found[1])
        if seen is None or seen.turning or seen.commanded < STILL:
            self._told_to_turn = None
            return 0.0
        if self._told_to_turn is None:
            self._told_to_turn = now
        return now - self._told_to_turn

    def _dated(self, link: Link, time: float) -> Link:
        """Return a link with the time since when it is so, where nobody has told that."""
        state = link.level, link.clause
        if (known := self._known.get(link.name)) is None or known[0] != state:
            self._known[link.name] = known = state, time
        return link if link.since is not None else link._replace(since=known[1])


def chained(links: tuple[Link, ...]) -> Chain:
    """Return links with the sentence that leads from the first of them to its first cause."""
    on_the_way = way(links)
    cause = on_the_way[-1]
    clauses = [link.clause for link in on_the_way if link.clause]
    parts = [*clauses, cause.remedy] if cause.remedy else clauses
    level = worst(*(link.level for link in on_the_way))
    return Chain(links, ': '.join(parts), cause, level)
