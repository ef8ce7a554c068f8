"""A link of the chain of reasons: how one part of a robot is, and what that goes back to."""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple


class Level(IntEnum):
    """How bad it is; the numbers are those of diagnostic_msgs/DiagnosticStatus."""

    OK = 0
    WARN = 1
    ERROR = 2
    STALE = 3
    """nothing is known, or what is known is old"""


SEVERITY = (Level.OK, Level.WARN, Level.STALE, Level.ERROR)
"""From the best to the worst: what stands by mistake is worse than what is silent."""


def worst(*levels: Level) -> Level:
    """Return the worst of some levels; without one, OK."""
    return max(levels, key=SEVERITY.index, default=Level.OK)


class Link(NamedTuple):
    """How one part of a robot is."""

    name: str
    """of the part: wheels, cmd_vel, decision, pose, sap flow, probe_1 ..."""
    level: Level
    sentence: str
    """how it is, in plain English, with times and numbers"""
    clause: str
    """the same in a few words, for the headline, empty where it adds nothing; a new one means that
    something has changed"""
    because: str = ''
    """name of the link that it goes back to; empty: to none, it is a first cause"""
    remedy: str = ''
    """what a person can do; empty if nothing needs to be done"""
    limit: str = ''
    """what limits it; empty if nothing does"""
    age: float | None = None
    """[s] how old the newest is that was heard of it; None if nothing ever was"""
    since: float | None = None
    """when it became so, by the robot's clock [s since 1970]; None where nobody knows"""


class Chain(NamedTuple):
    """All links of one robot, from the wheels back to the probes."""

    links: tuple[Link, ...]
    headline: str
    """one sentence: what the wheels do, why, and the remedy of the first cause"""
    cause: Link
    """the first cause"""
    level: Level
    """the worst on the way to it"""

    def way(self) -> list[Link]:
        """Return the links from the wheels to the first cause."""
        return way(self.links)


def way(links: tuple[Link, ...]) -> list[Link]:
    """Return the links from the first one on to that which goes back to none."""
    by_name = {link.name: link for link in links}
    found = [links[0]]
    while (after := by_name.get(found[-1].because)) is not None and after not in found:
        found.append(after)
    return found
