"""Messages that are rows of numbers: one is filled at a time, or many together as a table.

Live, each row becomes a message at once. Over a recording a row goes to the nodes that listen as
it is, and rows become messages many together, to the bit the same.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray


class Rows(Protocol):
    """How rows of one kind become messages, and the other way."""

    def message(self) -> Any:
        """Return a message of such a row, all but its numbers and stamp filled in."""

    def fill(self, message: Any, row: Any) -> None:
        """Write a row into a message."""

    def fill_table(self, table: NDArray[Any], rows: Sequence[Any]) -> None:
        """Write many rows into the columns of a table, one for each field of the message."""

    def read(self, message: Any) -> Any:
        """Return the row of a message.

        Raises:
            SignalError: A number in it is not finite.

        """
