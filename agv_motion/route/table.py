"""A piecewise-linear table: what a profile of the route follower is given as."""

from __future__ import annotations

from bisect import bisect_right
from itertools import pairwise
from math import inf, isfinite
from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Sequence


class ProfileTable:
    """Straight lines between rows (x, y), and constant outside of them."""

    def __init__(self, name: str, flat: Sequence[float], highest: float = inf) -> None:
        """Check and keep the rows.

        Args:
            name: What the table is called in messages.
            flat: x0, y0, x1, y1 ... with x rising.
            highest: Largest x that makes sense.

        Raises:
            ConfigurationError: No row, half a row, a number that is not finite, an x that is
                negative or above ``highest``, or rows that are unsorted or overlap.

        """
        self.name = name
        values = [float(value) for value in flat]
        if not values or len(values) % 2:
            _refuse(name, f'{len(values)} numbers: give pairs x0, y0, x1, y1 ...')
        self.x, self.y = values[::2], values[1::2]
        for x, y in zip(self.x, self.y, strict=True):
            if not isfinite(x) or not isfinite(y):
                _refuse(name, f'row ({x}, {y}) is not finite: give numbers')
            if not 0.0 <= x <= highest:
                _refuse(name, f'row ({x:g}, {y:g}): x must lie in [0, {highest:g}]')
        for first, second in pairwise(self.x):
            if first == second:
                _refuse(name, f'two rows overlap at x = {first:g}: leave one of them out')
            if first > second:
                _refuse(name, f'x = {second:g} comes after x = {first:g}: sort the rows by x')

    def __call__(self, x: float) -> float:
        """Return y at ``x``."""
        above = bisect_right(self.x, x)
        if above == 0:
            return self.y[0]
        if above == len(self.x):
            return self.y[-1]
        x0, y0 = self.x[above - 1], self.y[above - 1]
        return y0 + (x - x0) * (self.y[above] - y0) / (self.x[above] - x0)

    def require_positive(self) -> ProfileTable:
        """Return the table if every y is positive.

        Raises:
            ConfigurationError: One is not; the message names the row.

        """
        for x, y in zip(self.x, self.y, strict=True):
            if y <= 0.0:
                _refuse(
                    self.name,
                    f'{y:g} m/s at x = {x:g}: must be positive, or the robot stalls short of the '
                    'goal; only v_d may reach 0',
                )
        return self

    def require_zero_at_zero(self, why: str) -> ProfileTable:
        """Return the table if it is 0 at 0 and nowhere negative.

        Args:
            why: What would happen otherwise.

        Raises:
            ConfigurationError: It is not so; the message names the row.

        """
        if self(0.0) != 0.0:
            _refuse(self.name, f'{self(0.0):g} at 0: {why}; let it begin with 0, 0')
        for x, y in zip(self.x, self.y, strict=True):
            if y < 0.0:
                _refuse(self.name, f'{y:g} at x = {x:g}: must not be negative')
        return self

    def require_above_for_good(self, least: float) -> ProfileTable:
        """Return the table if it stays above ``least`` once it is.

        Args:
            least: Speed at which the robot counts as arrived [m/s].

        Raises:
            ConfigurationError: It is never above, or not any more; the message names the row.

        """
        moving = [x for x, y in zip(self.x, self.y, strict=True) if y > least]
        if not moving:
            _refuse(
                self.name,
                f'nowhere above {least:g} m/s, at which it counts as arrived: give a row above, or '
                'lower arrival_speed',
            )
        for x, y in zip(self.x, self.y, strict=True):
            if y <= least and x > moving[0]:
                _refuse(
                    self.name,
                    f'{y:g} m/s again at x = {x:g}: there it would count as arrived, at '
                    f'{least:g} m/s; raise it, or lower arrival_speed',
                )
        return self


def _refuse(name: str, reason: str) -> None:
    msg = f'{name}: {reason}'
    raise ConfigurationError(msg)
