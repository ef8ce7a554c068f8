"""Litres that a tree drank, as a node told them since each midnight: in all, and in words."""

from __future__ import annotations

from math import isfinite
from typing import NamedTuple

from agv_motion.probe.water import Litres

ROUNDED = 1e-6
"""[l] by which an amount may fall and still be the same"""


class _Stretch(NamedTuple):
    """What was told without falling: from midnight, or from a start of the node."""

    first: float
    last: Litres

    def drunk(self, *, from_nothing: bool) -> Litres:
        """Return what was drunk in it; what makes it uncertain is a factor of all of it."""
        if from_nothing or not self.last.value:
            return self.last
        share = max(1.0 - self.first / self.last.value, 0.0)
        return Litres(*(share * each for each in self.last))


class LitresDrunk:
    """What was drunk over all that is told, whenever it begins again at nothing."""

    def __init__(self) -> None:
        """Start without a word."""
        self._stretches: list[_Stretch] = []

    def add(self, value: float, low: float, high: float) -> bool:
        """Take what was drunk since midnight [l]; return whether these are numbers."""
        told = Litres(value, low, high)
        if not all(map(isfinite, told)):
            return False
        before = self._stretches[-1] if self._stretches else None
        if before is None or value < before.last.value - ROUNDED:
            self._stretches.append(_Stretch(value, told))
        else:
            self._stretches[-1] = before._replace(last=told)
        return True

    @property
    def stretches(self) -> int:
        """How often it began: days, if the node never started anew."""
        return len(self._stretches)

    def since_midnight(self) -> Litres | None:
        """Return what was told last [l]; None without a word."""
        return self._stretches[-1].last if self._stretches else None

    def total(self) -> Litres | None:
        """Return what was drunk from the first word to the last [l]; None without a word.

        The interval is that of one and the same tree: what is uncertain of one day is so of all.
        """
        if not self._stretches:
            return None
        parts = [s.drunk(from_nothing=i > 0) for i, s in enumerate(self._stretches)]
        return Litres(*map(sum, zip(*parts, strict=True)))


def in_litres(litres: Litres) -> str:
    """Return an amount with its 95 % interval: "12.3 L (10.1 to 15.0)"."""
    digits = 2 if litres.high < 10.0 else 1
    value, low, high = (f'{each:.{digits}f}' for each in litres)
    return f'{value} L ({low} to {high})'
