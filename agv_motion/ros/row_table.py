"""Messages in CDR of many rows together, to the bit as one by one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.bag.cdr.message_rows import MessageRows
from agv_motion.ros.cdr import codec
from agv_motion.ros.messages import type_name

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from agv_motion.ros.rows import Rows

SECOND = 1_000_000_000


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
