"""Messages that are rows of numbers: one is filled at a time, or many together as a table.

Live, each row becomes a message at once. Over a recording a row goes to the nodes that listen as
it is, and rows become messages many together, to the bit the same.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from agv_motion.bag.cdr.message_rows import MessageRows
from agv_motion.ros.cdr import codec
from agv_motion.ros.messages import type_name

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

SECOND = 1_000_000_000


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


class Table:
    """Makes messages in CDR of many rows together."""

    def __init__(self, rows: Rows) -> None:
        """Prepare for messages like the one that ``rows`` has, with a header."""
        example = rows.message()
        kind: Any = type(example)
        self._rows, self._form = rows, MessageRows(type_name(kind), codec(kind).encode(example))

    def messages(self, stamps: NDArray[np.int64], rows: Sequence[Any]) -> list[bytes]:
        """Return one message for each row, with its stamp [ns]."""
        table = self._form.table(len(rows))
        table['header.stamp.sec'], table['header.stamp.nanosec'] = np.divmod(stamps, SECOND)
        self._rows.fill_table(table, rows)
        return self._form.messages(table)
