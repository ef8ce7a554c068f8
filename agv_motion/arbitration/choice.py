"""What an arbiter has decided: who drives, and how each source stands."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping

    from agv_motion.arbitration.source import TwistSource
    from agv_motion.planar import Twist


class Verdict(Enum):
    """How a source stands."""

    DRIVES = 'drives'
    """What it asks for is commanded, be it zero."""
    HOLDS = 'holds'
    """It is locked and silent, and the robot stands for it."""
    LOST = 'lost'
    """A dead-man fell silent while it drove, and the robot stands for it."""
    OUTRANKED = 'outranked'
    """It speaks, and so does one above it."""
    LOCKED_OUT = 'locked out'
    """It speaks, and one above it is locked, or lost."""
    STOPPED = 'stopped'
    """It speaks, and STOP holds."""
    SILENT = 'silent'
    """It has not spoken for its time-out."""
    NEVER = 'never spoke'
    """It has not spoken since this arbiter began, or was released."""


WAITING = frozenset({Verdict.OUTRANKED, Verdict.LOCKED_OUT, Verdict.STOPPED})
"""Verdicts of those who speak in vain."""


class Standing(NamedTuple):
    """How a source stands, and why."""

    verdict: Verdict
    waits_for: str
    """in words; empty if for nothing"""
    age: float | None
    """of what it said last [s]; None: it never spoke"""


class HeldStop(NamedTuple):
    """A STOP that holds."""

    reason: str
    """who asked for it, or what is wrong"""
    since: float
    """[s] since 1970, by the robot's clock"""


class Hold(NamedTuple):
    """What holds until a person releases it; it outlasts a restart."""

    stop: HeldStop | None = None
    locks: frozenset[TwistSource] = frozenset()
    """below each of these nothing drives, and where it is silent the robot stands"""
    lost: frozenset[TwistSource] = frozenset()
    """dead-men that fell silent while they drove; each holds until it speaks anew"""


FREE = Hold()


class Choice(NamedTuple):
    """What to command now, and why."""

    twist: Twist
    driver: TwistSource | None
    """whose the twist is, or for whom the robot stands; None: nobody speaks, and it stands"""
    standings: Mapping[TwistSource, Standing]
    hold: Hold

    @property
    def at_once(self) -> bool:
        """Whether the wheels must stand now, whatever ramp they would brake by."""
        return self.hold.stop is not None or self.driver in self.hold.lost
