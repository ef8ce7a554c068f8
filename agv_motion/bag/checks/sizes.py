"""How much of a bag each topic takes, by what the indexes tell of the places of messages."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from agv_motion.bag.mcap.chunked_file import ChunkedFile
    from agv_motion.bag.reader import BagReader


class TopicSize(NamedTuple):
    """What a topic takes."""

    size: int = 0
    """[bytes] of its messages, what stands before each in MCAP included, uncompressed"""
    stored: float = 0.0
    """[bytes] of them as they are stored, about"""


def sizes(bag: BagReader) -> dict[str, TopicSize]:
    """Return what each topic takes.

    Raises:
        DamagedBagError: An index is damaged.

    """
    found = dict.fromkeys(bag.topics, TopicSize())
    for file in bag.files:
        chunks = file.as_chunks()
        parts = _messages(bag) if chunks is None else _chunks(chunks)
        for topic, size, stored in parts:
            before = found[topic]
            found[topic] = TopicSize(before.size + size, before.stored + stored)
        if chunks is None:
            break
    return found


def _messages(bag: BagReader) -> Iterator[tuple[str, int, float]]:
    """Yield the size of each message of a bag without chunks."""
    for message in bag.messages():
        yield message.connection.topic, len(message.data), len(message.data)


def _chunks(file: ChunkedFile) -> Iterator[tuple[str, int, float]]:
    """Yield what each channel takes in each chunk: from each message to the next."""
    for chunk in file.chunks:
        told = file.entries(chunk)
        if not told:
            continue
        offsets = np.concatenate([one.offsets for one in told.values()])
        places = np.repeat(np.arange(len(told)), [len(one.offsets) for one in told.values()])
        order = np.argsort(offsets)
        ends = np.append(offsets[order][1:], np.uint64(chunk.size))
        lengths = (ends - offsets[order]).astype(np.float64)
        sums = np.bincount(places[order], weights=lengths, minlength=len(told))
        for channel, size in zip(told, sums.tolist(), strict=True):
            share = size * chunk.length / chunk.size if chunk.size else 0.0
            if channel in file.channels:  # else nothing describes it, and it is not read either
                yield file.channels[channel].topic, int(size), share
