"""What each topic of a bag had said last before a moment: what a listener would have known then."""

from __future__ import annotations

from collections import deque
from operator import attrgetter
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from agv_motion.bag.connection import Message
    from agv_motion.bag.reader import BagReader

FIRST = 5_000_000_000
"""[ns] that are read at first; then four times as far back, and so on"""


def last_before(
    bag: BagReader, topics: Iterable[str], stamp: int,
    enough: Callable[[], bool] = lambda: False,
) -> dict[str, Message]:  # fmt: skip
    """Return the last message of each topic before a moment, by topic; of some there is none.

    Reads backwards in growing stretches, and in each only what is still looked for.

    Args:
        bag: The bag.
        topics: Their names.
        stamp: The moment [ns]; a message of just then is not before it.
        enough: Asked between two stretches; whether to be content with what was found.

    Raises:
        ConfigurationError: A topic is not in the bag.
        SourceError: The bag is damaged.

    """
    found = latest_before(bag, dict.fromkeys(topics, 1), stamp, enough)
    return {message.connection.topic: message for message in found}


def latest_before(
    bag: BagReader, counts: Mapping[str, int], stamp: int,
    enough: Callable[[], bool] = lambda: False,
) -> list[Message]:  # fmt: skip
    """Return the last messages of each topic before a moment, in the order of time.

    Args:
        bag: The bag.
        counts: Number of messages of each topic, at most.
        stamp: The moment [ns]; a message of just then is not before it.
        enough: Asked between two stretches; whether to be content with what was found.

    Raises:
        ConfigurationError: A topic is not in the bag.
        SourceError: The bag is damaged.

    """
    bag.require(counts)
    left = {topic: count for topic, count in counts.items() if count > 0}
    found: list[Message] = []
    stop, span = stamp, FIRST
    while left and stop > bag.start and not enough():
        start = max(stop - span, bag.start)
        latest: dict[str, deque[Message]] = {t: deque(maxlen=count) for t, count in left.items()}
        for message in bag.messages(left, start, stop):
            latest[message.connection.topic].append(message)
        found += (message for messages in latest.values() for message in messages)
        left = {t: count - len(latest[t]) for t, count in left.items() if count > len(latest[t])}
        stop, span = start, 4 * span
    return sorted(found, key=attrgetter('stamp'))
