"""The last fixes and what was believed after each, so that a late one can take its place in time.

A late fix is put where it belongs, and those after it are taken in again: the result, gate and
all, is the same as if it had come in time.

After a long silence the gate is wide, and an outlier may pass. It then shuts the gate on the sound
fixes that follow: so when several in a row are rejected that would have passed without the last
one that was accepted, that one is outvoted.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from operator import sub
from typing import TYPE_CHECKING

from agv_motion.odometry.belief import Belief, Drift, take
from agv_motion.odometry.chi_square import chi_square_quantile

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.odometry.alignment import FixAtPose

VOTERS = range(3, 8)
"""How many fixes in a row are rejected when it is asked whether the one before was the outlier."""
LONGEST_STREAK = 24
"""Rejected fixes in a row that are kept, spread over the time that they must span."""


@dataclass
class _Entry:
    sighting: FixAtPose
    after: Belief
    accepted: bool = False
    outvoted: bool = False


class FixBuffer:
    """The belief, and the fixes that led to it since a horizon."""

    def __init__(
        self, belief: Belief, drift: Drift, gate: float, fewest: int = 5, span: float = 10.0
    ) -> None:
        """Start from a belief.

        Args:
            belief: Before the first fix.
            drift: What makes odometry and fixes part even at rest.
            gate: Probability with which a sound fix passes.
            fewest: Rejected fixes in a row that are kept however old they are.
            span: Time over which rejected fixes in a row are kept, however many come [s].

        """
        self._before = belief
        self._drift = drift
        self._gates = chi_square_quantile(gate, 2), chi_square_quantile(gate, 3)
        self._fewest, self._span = max(fewest, VOTERS.stop), span
        self._entries: list[_Entry] = []

    @property
    def belief(self) -> Belief:
        """What is believed after the last fix."""
        return self._entries[-1].after if self._entries else self._before

    @property
    def start(self) -> float:
        """Stamp of the belief before the first fix: none earlier can be taken in [s]."""
        return self._before.waypoint.stamp

    def __contains__(self, sighting: FixAtPose) -> bool:
        """Return whether the very same fix is there already."""
        return any(entry.sighting.fix == sighting.fix for entry in self._entries)

    def rejected(self) -> Sequence[FixAtPose]:
        """Return the fixes since the last one that was accepted, in the order of time."""
        return [entry.sighting for entry in self._entries[self._streak() :]]

    def take(self, sighting: FixAtPose) -> bool:
        """Take in a fix that is not before the start; return whether it passed the gate."""
        entries = self._entries
        place = bisect_right([entry.sighting.fix.stamp for entry in entries], sighting.fix.stamp)
        entry = _Entry(sighting, self._before)
        entries.insert(place, entry)
        self._replay(place)
        streak = self._streak()
        if streak and len(entries) - streak in VOTERS:
            self._vote(streak - 1)
        return entry.accepted

    def _replay(self, place: int) -> int:
        """Take in the fixes from ``place`` on again; return how many of them pass the gate."""
        belief = self._entries[place - 1].after if place else self._before
        passed = 0
        for entry in self._entries[place:]:
            fix, waypoint = entry.sighting
            taken, distance = take(belief, waypoint, fix, self._drift)
            inside = distance <= self._gates[fix.heading is not None]
            entry.accepted = inside and not entry.outvoted
            if entry.accepted:
                belief = taken
                passed += 1
            entry.after = belief
        return passed

    def _vote(self, place: int) -> None:
        """Leave out the fix at ``place`` if that lets enough of those after it pass."""
        self._entries[place].outvoted = True
        if self._replay(place) < VOTERS.start:
            self._entries[place].outvoted = False
            self._replay(place)

    def forget(self, before: float) -> None:
        """Drop the fixes before a stamp [s], but for the last accepted and those rejected since."""
        streak = self._streak()
        done = 0
        while done < streak - 1 and self._entries[done].sighting.fix.stamp < before:
            self._before = self._entries[done].after
            done += 1
        del self._entries[:done]
        streak -= done
        self._thin(streak)

    def _thin(self, streak: int) -> None:
        """Keep of the rejected fixes, which changed nothing, a few that span the last seconds.

        However often they come: the one whose neighbours are nearest in time is left out.
        """
        entries = self._entries
        while len(entries) - streak > self._fewest and (
            entries[-1].sighting.fix.stamp - entries[streak + 1].sighting.fix.stamp >= self._span
        ):
            del entries[streak]
        while len(entries) - streak > LONGEST_STREAK:
            stamps = [entry.sighting.fix.stamp for entry in entries[streak:]]
            gaps = list(map(sub, stamps[2:], stamps))
            del entries[streak + 1 + gaps.index(min(gaps))]

    def _streak(self) -> int:
        """Return the place after the last accepted fix."""
        place = len(self._entries)
        while place and not self._entries[place - 1].accepted:
            place -= 1
        return place
