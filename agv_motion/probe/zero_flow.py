"""The zero-flow value dT_max of a probe, as a live robot can know it: causal and latched.

Before dawn the tree hardly drinks and dT is highest. Each night gives one value, the highest
reading of the hours before dawn; what the last nights make of dT_max is the method's. It changes
only when a night ends, never while the tree drinks.

Source: P. J. Lu et al., "Granier's thermal dissipation probe method for measuring sap flow in
trees: theory and practice", Acta Botanica Sinica 46, 2004.
"""

from __future__ import annotations

from math import isfinite
from statistics import median
from typing import TYPE_CHECKING, Any

from agv_motion.errors import ConfigurationError
from agv_motion.probe.environment import UNKNOWN, Environment

if TYPE_CHECKING:
    from agv_motion.probe.zero_flow_method import ZeroFlowMethod

DAY = 86400.0
LOWEST, HIGHEST = 0.8, 1.1
"""Shares of dT_max between which dT may step and still be of the same probe: K up to 0.25."""


class _Night:
    """A pre-dawn window that is not over yet."""

    def __init__(self, day: int) -> None:
        self.day = day
        self._records: list[tuple[float, float, bool]] = []
        """each median of three that was above all before: time [s], the median [K], and whether
        it told zero flow"""
        self._last_three: list[float] = []

    @property
    def highest(self) -> float:
        """Highest of the medians of three [K]; 0 where there is none."""
        return self._records[-1][1] if self._records else 0.0

    @property
    def counts(self) -> bool:
        """Whether that told zero flow."""
        return bool(self._records) and self._records[-1][2]

    def add(self, time: float, temperature_difference: float, method: ZeroFlowMethod) -> None:
        self._last_three = [*self._last_three[-2:], temperature_difference]
        if len(self._last_three) == 3:
            highest = median(self._last_three)
            if highest > self.highest:
                self._records.append((time, highest, method.counts()))

    def distrust(self, since: float) -> bool:
        """Forget what came from ``since`` [s] on; return whether that changes what it told."""
        self._last_three, before = [], self.highest
        while self._records and self._records[-1][0] >= since:
            self._records.pop()
        return self.highest < before


class ZeroFlow:
    """Zero flow of the nights of a window, by one of the methods."""

    def __init__(
        self, night_start: float, night_end: float, method: ZeroFlowMethod, solar_offset: float
    ) -> None:
        """Start without any night.

        Args:
            night_start: First hour of the pre-dawn window, local solar time [h].
            night_end: Hour at which it ends and the value is latched [h].
            method: What nights make of zero flow, and for how many days.
            solar_offset: Local solar time minus UTC [h]; the longitude in degrees / 15.

        """
        self._hours = night_start * 3600.0, night_end * 3600.0
        self._method = method
        self._offset = solar_offset * 3600.0
        self._nights: dict[int, float] = {}
        self._aside: dict[int, float] = {}
        """nights before dT stepped away"""
        self._open: _Night | None = None
        self._latched: _Night | None = None
        """the last one that is over"""
        self.value: float | None = None

    def update(
        self, time: float, temperature_difference: float, environment: Environment = UNKNOWN
    ) -> float | None:
        """Take in one good reading and return dT_max; None while no recent night is known.

        A reading counts as the median of itself and the two before, so that no single one
        decides.

        Args:
            time: Of the reading, seconds since 1970, UTC.
            temperature_difference: dT, in any unit [K].
            environment: The air at that time.

        """
        if self._aside and self._is_of_this_probe(temperature_difference):
            self._nights, self._aside, self._open = self._aside, {}, None
            self.value = self._level(self._nights)
        self._method.observe(time, temperature_difference, environment)
        day, second = divmod(time + self._offset, DAY)
        if self._nights and day < max(self._nights):
            self._set_back(int(day))
        night = self._hours[0] <= second < self._hours[1]
        if self._open is not None and (int(day) != self._open.day or not night):
            self._latch(self._open)
        if night:
            self._open = self._open or _Night(int(day))
            self._open.add(time, temperature_difference, self._method)
        if self._nights and int(day) - max(self._nights) > self._method.days:
            self._nights, self.value = {}, None
        return self.value

    def recalibrate(self, time: float, temperature_difference: float) -> None:
        """Forget all nights and take ``temperature_difference`` as zero flow from now on."""
        self._nights = {int((time + self._offset) // DAY): temperature_difference}
        self._aside = {}
        self._open = self._latched = None
        self.value = temperature_difference

    @property
    def last_known(self) -> float | None:
        """dT_max, or what it was before the level stepped away [K]."""
        return self._level(self._aside) if self._aside else self.value

    def step(self, temperature_difference: float) -> None:
        """Set the nights aside if a reading to which dT has stepped cannot be of this probe [K].

        It is another needle, or noise that stood still. They count again with the first reading
        that can be of it, if no night has told a new zero flow before.
        """
        if self._nights and not self._is_of_this_probe(temperature_difference):
            self._aside, self._nights, self.value = self._nights, {}, None
            self._open = self._latched = None

    def _set_back(self, day: int) -> None:
        """Count the nights from ``day`` on, which a clock shows that was set back.

        They are as long ago as before; by the old clock they would be of days to come, and the
        last of them would be zero flow until those days are over.
        """
        later = max(self._nights) - day
        self._nights = {night - later: value for night, value in self._nights.items()}
        self._latched = None
        if self._open is not None and self._open.day > day:
            self._open = None

    def distrust(self, since: float) -> None:
        """Take back what a night told by readings from ``since`` [s] on, which were noise."""
        if self._open is not None:
            self._open.distrust(since)
        night = self._latched
        if night is not None and night.distrust(since) and night.day in self._nights:
            del self._nights[night.day]
            if night.counts:
                self._nights[night.day] = night.highest
            self.value = self._level(self._nights) if self._nights else None

    def _is_of_this_probe(self, temperature_difference: float) -> bool:
        known = self.last_known
        return known is None or LOWEST * known <= temperature_difference <= HIGHEST * known

    def _latch(self, night: _Night) -> None:
        """Let ``night`` count from now on, and those out of the window no longer."""
        if night.counts:
            self._nights[night.day], self._aside = night.highest, {}
            oldest = night.day - self._method.days
            self._nights = {d: value for d, value in self._nights.items() if d > oldest}
            self.value = self._level(self._nights)
        self._open, self._latched = None, night

    def state(self) -> dict[str, Any]:
        """Return what must survive a restart, ready for JSON."""
        return {'nights': [[day, value] for day, value in self._nights.items()]}

    def restore(self, state: dict[str, Any]) -> None:
        """Take up a :meth:`state`.

        Raises:
            ConfigurationError: It is not one.

        """
        try:
            nights = {int(day): float(value) for day, value in state['nights']}
            if not all(isfinite(value) for value in nights.values()):
                raise ValueError(nights)  # noqa: TRY301 - as unreadable as the rest
        except (KeyError, TypeError, ValueError, OverflowError) as error:
            msg = f'saved zero-flow nights are unreadable ({error!r:.120}): delete the state file'
            raise ConfigurationError(msg) from error
        self._nights = {day: value for day, value in nights.items() if 0.0 < value < 1e6}
        self.value = self._level(self._nights) if self._nights else None

    def _level(self, nights: dict[int, float]) -> float:
        return self._method.level([nights[day] for day in sorted(nights)])
