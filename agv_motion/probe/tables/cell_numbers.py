"""The numbers of a table: with point or comma, and what stands for none."""

from __future__ import annotations

import re
from math import isfinite, nan
from typing import TYPE_CHECKING

from agv_motion.errors import SourceError
from agv_motion.probe.tables.signs import DECIMALS, NUMBER

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from agv_motion.probe.tables.table_parameters import TableParameters

_WITH_COMMA = re.compile(r'[+-]?\d*,\d+(?:[eE][+-]?\d{1,3})?', re.ASCII)
_THOUSANDS = re.compile(r'[+-]?[1-9]\d{0,2},\d{3}', re.ASCII)


class CellNumbers:
    """Reads cells of one file, which writes all its numbers alike."""

    def __init__(self, decimal: str, missing: Sequence[str]) -> None:
        """Take the decimal sign, and the words of no value, as `csv.missing` has them."""
        self._decimal = decimal
        words = {word.strip().lower() for word in missing}
        self._words = {'', *words}
        self._numbers = {float(word) for word in words if NUMBER.fullmatch(word)}

    @classmethod
    def of(cls, cells: Iterable[str], given: TableParameters) -> CellNumbers:
        """Return what reads these cells.

        Raises:
            SourceError: Their commas may be decimal, or stand between thousands.

        """
        if chosen := DECIMALS.get(given.decimal):
            return cls(chosen, given.missing)
        points = commas = 0
        thousands = ''
        for cell in cells:
            if ',' not in cell:
                points += '.' in cell and bool(NUMBER.fullmatch(cell))
            elif _THOUSANDS.fullmatch(cell):
                thousands = cell
            else:
                commas += bool(_WITH_COMMA.fullmatch(cell))
        if thousands and not commas and not points:
            msg = f"'{thousands:.40}' may be a decimal number or thousands: choose by csv.decimal"
            raise SourceError(msg)
        return cls(',' if commas > points else '.', given.missing)

    def number(self, cell: str) -> float | None:
        """Return the number of a cell, NaN where it stands for none, None where it is no number."""
        if cell.lower() in self._words:
            return nan
        if self._decimal == ',':
            if '.' in cell:
                return None
            cell = cell.replace(',', '.')
        if not NUMBER.fullmatch(cell):
            return None
        number = float(cell)
        if number in self._numbers:
            return nan
        return number if isfinite(number) else None
