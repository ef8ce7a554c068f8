"""Which message of one bag belongs to which of another: by time, or by place."""

from __future__ import annotations

from functools import lru_cache
from struct import Struct, error
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.cdr.definitions import begins_with_header
from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from agv_motion.bag.connection import Message

_has_header = lru_cache(begins_with_header)
_LITTLE, _BIG = Struct('<iI'), Struct('>iI')


class Pairing(NamedTuple):
    """How the messages of a topic find their partners.

    Without ``within``, those of the same stamp in their header belong together, those without a
    header by their place. With ``within``, the nearest in time do, by the header or else by the
    time of arrival. By place, the n-th of one bag belongs to the n-th of the other.
    """

    by_place: bool = False
    within: int | None = None
    """[ns] how far apart the times of a pair may be, and any other times in them"""

    @property
    def tolerance(self) -> int | None:
        """How far apart times in a pair may be [ns]; None: as far as they like."""
        return self.within if self.by_place else self.within or 0


class Pair(NamedTuple):
    """Two messages that belong together; one of them None where a message has no partner."""

    first: Message | None
    second: Message | None


def pairs(first: Iterable[Message], second: Iterable[Message], pairing: Pairing) -> Iterator[Pair]:
    """Yield all messages of a topic of two bags, each exactly once, few of them in memory."""
    ours, theirs = _Stream(first, pairing), _Stream(second, pairing)
    window = pairing.within or 0
    while ours.message and theirs.message:
        apart = theirs.time - ours.time
        earlier, later = (ours, theirs) if apart >= 0 else (theirs, ours)
        if abs(apart) > window or (apart and earlier.next_is_nearer(later.time)):
            message = earlier.take()
            yield Pair(message, None) if earlier is ours else Pair(None, message)
        else:
            yield Pair(ours.take(), theirs.take())
    while ours.message:
        yield Pair(ours.take(), None)
    while theirs.message:
        yield Pair(None, theirs.take())


class _Stream:
    """The messages of one bag: the present one with its time, and a look at the next."""

    def __init__(self, messages: Iterable[Message], pairing: Pairing) -> None:
        self._rest = iter(messages)
        self._pairing = pairing
        self._following = next(self._rest, None)
        self.message: Message | None = None
        self.time: int
        """[ns] of the present one"""
        self.take()

    def take(self) -> Message | None:
        """Go on by one message; return the one that was present."""
        taken, self.message = self.message, self._following
        if self.message is not None:
            self.time = self._time(self.message)
            self._following = next(self._rest, None)
        return taken

    def next_is_nearer(self, time: int) -> bool:
        """Return whether the next message is nearer to a time [ns] than the present one."""
        if self._following is None:
            return False
        return abs(self._time(self._following) - time) < abs(self.time - time)

    def _time(self, message: Message) -> int:
        if self._pairing.by_place:
            return 0
        if _has_header(message.connection.definition):
            return _header_stamp(message)
        return message.stamp if self._pairing.within is not None else 0


def _header_stamp(message: Message) -> int:
    """Return the stamp [ns] of a message that begins with a header.

    Raises:
        SourceError: The message is too short for one.

    """
    try:
        form = _LITTLE if message.data[1] & 1 else _BIG
        seconds, rest = form.unpack_from(message.data, 4)
    except (IndexError, error):
        topic = message.connection.topic
        msg = (
            f'{topic}: the message at {message.stamp} ns has {len(message.data)} bytes, too few '
            f'for the header of {message.connection.type}; agv bag check tells more'
        )
        raise SourceError(msg) from None
    return int(seconds * 1_000_000_000 + rest)
