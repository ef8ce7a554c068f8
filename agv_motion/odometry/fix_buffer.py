"""The last fixes and what was believed after each, so that a late one can take its place in time.

A late fix is put where it belongs, and those after it are taken in again: the result, gate and
all, is the same as if it had come in time.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from typing import TYPE_CHECKING

from agv_motion.odometry.belief import Belief, Drift, take
from agv_motion.odometry.chi_square import chi_square_quantile

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.odometry.alignment import Sighting

LONGEST_STREAK = 24
"""Rejected fixes in a row that are kept; of more, the oldest is dropped."""


@dataclass
class _Entry:
    sighting: Sighting
    after: Belief
    accepted: bool


class FixBuffer:
    """The belief, and the fixes that led to it since a horizon."""

    def __init__(self, belief: Belief, drift: Drift, gate: float) -> None:
        """Start from a belief.

        Args:
            belief: Before the first fix.
            drift: What makes odometry and fixes part even at rest.
            gate: Probability with which a sound fix passes.

        """
        self._before = belief
        self._drift = drift
        self._gates = chi_square_quantile(gate, 2), chi_square_quantile(gate, 3)
        self._entries: list[_Entry] = []

    @property
    def belief(self) -> Belief:
        """What is believed after the last fix."""
        return self._entries[-1].after if self._entries else self._before

    @property
    def start(self) -> float:
        """Stamp of the belief before the first fix: none earlier can be taken in [s]."""
        return self._before.waypoint.stamp

    def __contains__(self, sighting: Sighting) -> bool:
        """Return whether the very same fix is there already."""
        return any(entry.sighting.fix == sighting.fix for entry in self._entries)

    def rejected(self) -> Sequence[Sighting]:
        """Return the fixes since the last one that was accepted, in the order of time."""
        return [entry.sighting for entry in self._entries[self._streak() :]]

    def take(self, sighting: Sighting) -> bool:
        """Take in a fix that is not before the start; return whether it passed the gate."""
        entries = self._entries
        place = bisect_right([entry.sighting.fix.stamp for entry in entries], sighting.fix.stamp)
        before = entries[place - 1].after if place else self._before
        entry = _Entry(sighting, before, accepted=False)
        entries.insert(place, entry)
        belief = before
        for again in entries[place:]:
            fix, waypoint = again.sighting
            taken, distance = take(belief, waypoint, fix, self._drift)
            again.accepted = distance <= self._gates[fix.heading is not None]
            belief = again.after = taken if again.accepted else belief
        return entry.accepted

    def forget(self, before: float) -> None:
        """Drop the fixes before a stamp [s], but for those rejected since the last accepted."""
        streak = self._streak()
        done = 0
        while done < streak and self._entries[done].sighting.fix.stamp < before:
            self._before = self._entries[done].after
            done += 1
        del self._entries[:done]
        streak -= done
        while len(self._entries) - streak > LONGEST_STREAK:  # a rejected fix changed nothing
            del self._entries[streak]

    def _streak(self) -> int:
        """Return the place after the last accepted fix."""
        place = len(self._entries)
        while place and not self._entries[place - 1].accepted:
            place -= 1
        return place
