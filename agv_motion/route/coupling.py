r"""Coupling: a commanded speed that follows its target gently after a start and at every corner.

.. math:: out_t = out_{t-1} + c_t (target_t - out_{t-1}) \tag{1}

c grows from 0 to 1 within a given time after each reset. Applied once a tick, (1) means something
else at each rate: at 100 Hz there are ten shares taken where there is one at 10 Hz, so the gap to
the target closes in a fraction of the time. What c says is which share of the gap that there was
at the reset has been closed. So from one tick to the next the gap shrinks by

.. math:: \frac{1 - c_t}{1 - c_{t-1}} \tag{2}

whose product over all ticks is 1 - c, whatever the ticks: after half the time half of the gap is
left, and at its end the output is the target. The first tick after a reset is the same in (1) and
(2).
"""

from __future__ import annotations

from enum import Enum
from math import inf


class CouplingForm(Enum):
    """How the gap to the target is closed."""

    CORRECTED = 'corrected'
    """By (2): the same at any rate"""
    PER_TICK = 'per_tick'
    """By (1), once a tick"""
    ORIGINAL = 'seed'
    """As the original has it: the last *target* stands in place of the last output in (1)"""


ROUNDING = 1e-9
"""A share this near to 1 is 1: the sum of many small steps may miss it."""


class Coupling:
    """One coupled speed."""

    def __init__(
        self, ramp: float = 0.0, form: CouplingForm = CouplingForm.CORRECTED, output: float = 0.0
    ) -> None:
        """Start coupling.

        Args:
            ramp: Time in which c grows from 0 to 1 [s]; 0: no coupling.
            form: How.
            output: Speed at the start.

        """
        self.set(ramp, form)
        self._target = self.output = output
        self.reset()

    def set(self, ramp: float, form: CouplingForm) -> None:
        """Go on with another time [s] and form."""
        self._ramp, self._form = ramp, form

    def reset(self) -> None:
        """Set c to 0."""
        self.share = 0.0

    def rest(self) -> None:
        """Start anew from standstill."""
        self.output = self._target = 0.0
        self.reset()

    def follow(self, target: float, dt: float) -> float:
        """Return the output when the target is ``target`` and ``dt`` [s] have passed."""
        before = self.share
        self.share = before + dt / self._ramp if self._ramp > 0.0 else inf
        if self.share > 1.0 - ROUNDING:
            self.share = 1.0
        last = self._target if self._form is CouplingForm.ORIGINAL else self.output
        share = self.share
        if self._form is CouplingForm.CORRECTED and before < 1.0:
            share = (share - before) / (1.0 - before)
        self.output = target if share == 1.0 else last + share * (target - last)
        self._target = target
        return self.output
