"""Watches what is recorded for the moments at which a condition begins to be met."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.bag.columns.columns import columns_of
from agv_motion.bag.columns.condition import begins, meets
from agv_motion.bag.events.event import Moment
from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from agv_motion.bag.columns.condition import Condition
    from agv_motion.bag.connection import Connection, Message


class Trigger:
    """One condition, and whether it is met at present."""

    def __init__(self, wanted: Condition) -> None:
        """Know no topic yet."""
        self.wanted = wanted
        self.problem = ''
        """why it cannot tell; empty: it can, or its topic has not come yet"""
        self.connection: Connection | None = None
        self._met = False

    def fits(self, topic: str) -> bool:
        """Return whether it may be about a field of a topic."""
        return f'{self.wanted.name}/'.startswith(f'{topic}/')

    def bind(self, connection: Connection) -> None:
        """Watch a topic, unless a longer name is known that fits; a misfit is a ``problem``."""
        known = self.connection
        if known is not None and len(known.topic) > len(connection.topic):
            return
        try:
            self._find(connection, [])
        except AgvMotionError as error:
            self.problem = self.problem if known else str(error)
        else:
            self.connection, self.problem = connection, ''
            self._met = self._met and known is not None and known.topic == connection.topic

    def moments(self, messages: Sequence[Message]) -> list[Moment]:
        """Return when the condition began to be met; a message that is damaged is passed over."""
        if self.connection is None or not messages:
            return []
        try:
            found = self._find(self.connection, messages)
        except AgvMotionError as error:
            self.problem = str(error)
            return []
        self.problem = ''
        stamps = sorted(message.stamp for message in messages)
        begun = begins(found, before=self._met).tolist()
        self._met = bool(found[-1])
        return [Moment(s, str(self.wanted)) for s, new in zip(stamps, begun, strict=True) if new]

    def _find(self, connection: Connection, messages: Sequence[Message]) -> NDArray[np.bool_]:
        """Return which messages, in the order of time, meet the condition."""
        field = self.wanted.name[len(connection.topic) :].strip('/').replace('/', '.')
        columns = columns_of(connection, [field] if field else None, messages)
        return meets(self.wanted, columns.fields, named=bool(field))
