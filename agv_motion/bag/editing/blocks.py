"""Messages in blocks, of which the next is read while one is written: each waits for the disk."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

from agv_motion.bag.mcap.records import MESSAGE_HEAD

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from agv_motion.bag.connection import Message

MOST = 1 << 16
"""messages of a block"""


def blocks_ahead(messages: Iterable[Message], size: int) -> Iterator[list[Message]]:
    """Yield messages in blocks; another thread reads the next one meanwhile.

    Args:
        messages: They are read by one thread at a time, which is not always the same.
        size: [bytes] from which on a block is full, as they lie in a chunk.

    Raises:
        Exception: What reading raises, after the blocks before.

    """
    blocks = _blocks(messages, size)
    with ThreadPoolExecutor(1) as reader:
        coming = reader.submit(next, blocks, None)
        while (block := coming.result()) is not None:
            coming = reader.submit(next, blocks, None)
            yield block


def _blocks(messages: Iterable[Message], most: int) -> Iterator[list[Message]]:
    block: list[Message] = []
    size = 0
    for message in messages:
        block.append(message)
        size += len(message.data) + MESSAGE_HEAD.size
        if size >= most or len(block) >= MOST:
            yield block
            block, size = [], 0
    if block:
        yield block
