"""Where a robot was in the last minutes, and what it felt in the last day, both thinned."""

from __future__ import annotations

from collections import deque
from math import hypot
from typing import TYPE_CHECKING

from agv_motion.dashboard.core.numbers import thinned

if TYPE_CHECKING:
    from collections.abc import Sequence

MINUTES = 600.0
"""[s] that a trail goes back"""
STEP = 0.02
"""[m] that a robot must have gone for another point"""
MOST = 2000
"""points that are kept"""
SHOWN = 300
"""points that are sent"""

DAY = 86400.0
BUCKETS = 300
"""of a day"""


class Trail:
    """Places of one robot."""

    def __init__(self) -> None:
        """Start without a place."""
        self._places: deque[tuple[float, float, float]] = deque(maxlen=MOST)

    def add(self, now: float, x: float, y: float) -> bool:
        """Note a place [m] at a time [s]; return whether the trail has changed."""
        places = self._places
        changed = False
        while places and (now - places[0][0] > MINUTES or now < places[-1][0]):
            if now < places[-1][0]:
                places.pop()  # the clock went back: what came later did not happen
            else:
                places.popleft()
            changed = True
        if not places or hypot(x - places[-1][1], y - places[-1][2]) >= STEP:
            places.append((now, x, y))
            changed = True
        return changed

    def points(self) -> list[list[float]]:
        """Return the places, oldest first."""
        return [[round(x, 3), round(y, 3)] for _, x, y in thinned(list(self._places), SHOWN)]


class DayChart:
    """Three sap flows over the last 24 h: one row for each of `BUCKETS` stretches of it.

    What the tree drank today is their mean over time: hours at full flow.
    """

    def __init__(self) -> None:
        """Start without a row."""
        self._rows: deque[tuple[float, tuple[float, ...]]] = deque(maxlen=BUCKETS + 1)
        self._last: tuple[float, float] | None = None
        self._today = 0
        self._drunk = 0.0

    def add(self, time: float, flows: Sequence[float | None]) -> bool:
        """Note sap flows at a time of the robot [s since 1970]; return whether a row is new.

        A flow that is not known leaves a gap; a clock that goes back begins the chart anew.
        """
        known = tuple(flow for flow in flows if flow is not None)
        if len(known) < len(flows) or not known:
            self._last = None
            return False
        if self._rows and time < self._rows[-1][0]:
            self.__init__()  # type: ignore[misc] # as if nothing had been
        self._drink(time, sum(known) / len(known))
        while self._rows and time - self._rows[0][0] > DAY:
            self._rows.popleft()
        if self._rows and time - self._rows[-1][0] < DAY / BUCKETS:
            return False
        self._rows.append((time, known))
        return True

    def _drink(self, time: float, flow: float) -> None:
        day = int(time // DAY)
        if day != self._today:
            self._today, self._drunk = day, 0.0
        if self._last is not None and 0.0 < time - self._last[0] < 2.0 * DAY / BUCKETS:
            self._drunk += 0.5 * (flow + self._last[1]) * (time - self._last[0]) / 3600.0
        self._last = time, flow

    def value(self) -> dict[str, object]:
        """Return times [s since 1970], one list a probe, and hours at full flow today (UTC)."""
        rows = list(self._rows)
        found: dict[str, object] = {'times': [round(t, 1) for t, _ in rows]}
        for i in range(max((len(flows) for _, flows in rows), default=0)):
            found[f's{i + 1}'] = [round(f[i], 3) if i < len(f) else None for _, f in rows]
        found['drunk'] = round(self._drunk, 3)
        return found
