"""Log times of a bag, topic by topic, in the order of the file; no message is decoded."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.bag.request import listed

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from agv_motion.bag.reader import BagReader


def stamps(bag: BagReader, topics: Iterable[str] | None = None) -> dict[str, NDArray[np.int64]]:
    """Return when the messages of each topic were received [ns].

    An MCAP file with an index tells that without being unpacked.

    Raises:
        ConfigurationError: A topic is not in the bag.
        DamagedBagError: The bag is damaged.

    """
    wanted = list(bag.topics) if topics is None else listed(topics)
    bag.require(wanted)
    found: dict[str, list[NDArray[np.int64]]] = {topic: [] for topic in wanted}
    for file in bag.files:
        channels = {n: c.topic for n, c in file.channels.items() if c.topic in found}
        for channel, times in file.log_times(channels):
            found[channels[channel]].append(times)
    return {topic: _joined(parts) for topic, parts in found.items()}


def _joined(parts: list[NDArray[np.int64]]) -> NDArray[Any]:
    """Return all log times, without a sign where one lies beyond the year 2262."""
    times = np.concatenate(parts) if parts else np.empty(0, np.int64)
    return times.view(np.uint64) if len(times) and times.min() < 0 else times
