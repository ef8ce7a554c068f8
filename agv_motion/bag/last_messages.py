"""What each topic of a bag had said last before a moment: what a listener would have known then."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

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
    wanted, found = set(topics), {}
    bag.require(wanted)
    stop, span = stamp, FIRST
    while wanted and stop > bag.start and not enough():
        start = max(stop - span, bag.start)
        for message in bag.messages(wanted, start, stop):
            found[message.connection.topic] = message
        wanted -= found.keys()
        stop, span = start, 4 * span
    return found
