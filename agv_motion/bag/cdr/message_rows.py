"""Messages that differ in numbers alone, as rows of a table: many are read or written in one go.

rows = MessageRows('geometry_msgs/msg/PointStamped', one_of_them)
table = rows.table(1000)
table['point.x'] = numpy.linspace(0.0, 1.0, 1000)
messages = rows.messages(table)
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.bag.cdr.definitions import installed
from agv_motion.bag.cdr.layout import layout
from agv_motion.bag.cdr.message_type import unfold
from agv_motion.bag.cdr.primitives import ENCAPSULATION, NUMPY

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray


class MessageRows:
    """The layout that all messages have whose strings and lengths are those of an example."""

    def __init__(self, message_type: str, example: bytes) -> None:
        """Find every number in the example.

        Args:
            message_type: Such as ``geometry_msgs/msg/Twist``; it must be installed.
            example: In little-endian CDR, its header included.

        Raises:
            ConfigurationError: The type is not installed, or has wide strings.
            ValueError: The example is not of this type.

        """
        form = layout(unfold(message_type, installed(message_type).text, 'ros2msg'))
        walk = form.walk(example, ENCAPSULATION, len(example) - ENCAPSULATION, '<')
        self._example = np.frombuffer(example, np.uint8)
        fields: dict[str, tuple[Any, int]] = {}
        constant = [(0, 2), *((at + ENCAPSULATION, at + ENCAPSULATION + 4) for at in walk.guards)]
        for leaf in form.leaves:
            places = [
                (at + ENCAPSULATION, count, step) for at, count, step in walk.found[leaf.number]
            ]
            if leaf.type == 'string':
                constant += [(at, at + size) for at, size, _ in places]
            elif leaf.type != 'length' and len(places) == 1:
                at, count, step = places[0]
                kind = np.dtype(f'<{NUMPY[leaf.type]}')
                if step == kind.itemsize:
                    fields[leaf.path] = ((kind, (count,)) if leaf.dimensions else kind), at
        self.dtype = np.dtype(
            {
                'names': list(fields),
                'formats': [kind for kind, _ in fields.values()],
                'offsets': [at for _, at in fields.values()],
                'itemsize': len(example),
            }
        )
        """a field for each number by its path; arrays of messages are as in the example"""
        self._constant = np.concatenate([np.arange(*span) for span in constant])

    def read(self, messages: Sequence[bytes]) -> NDArray[Any] | None:
        """Return messages as rows; None if one of them has another layout or other strings."""
        size = len(self._example)
        if any(len(message) != size for message in messages):
            return None
        content = np.frombuffer(b''.join(messages), np.uint8).reshape(len(messages), size)
        if (content[:, self._constant] != self._example[self._constant]).any():
            return None
        return content.view(self.dtype)[:, 0]

    def table(self, count: int) -> NDArray[Any]:
        """Return rows like the example, to be filled by columns."""
        return np.tile(self._example, count).view(self.dtype)

    def messages(self, table: NDArray[Any]) -> list[bytes]:
        """Return the messages of a :meth:`table`."""
        data, size = table.tobytes(), len(self._example)
        return [data[i : i + size] for i in range(0, len(data), size)]
