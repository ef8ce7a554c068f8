"""What a bag asks of each of its files, whatever their format: a new one implements this."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
    from pathlib import Path

    import numpy as np
    from numpy.typing import NDArray

    from agv_motion.bag.columns.batch import Batch
    from agv_motion.bag.connection import Connection, Message
    from agv_motion.bag.damage import DamagedBagError
    from agv_motion.bag.mcap.chunked_file import ChunkedFile
    from agv_motion.bag.mcap.records import Attachment, Metadata
    from agv_motion.errors import SourceError


class Storage(Protocol):
    """One file of a bag. Its channels have numbers, and may be topics of the same name."""

    @property
    def path(self) -> Path:
        """The file, as the user knows it."""

    @property
    def problems(self) -> Sequence[SourceError]:
        """What is amiss in the file, though it can be read."""

    @property
    def indexed(self) -> bool:
        """Whether the file itself told where its messages lie."""

    @property
    def counted(self) -> bool:
        """Whether the number of messages is known without reading them."""

    @property
    def channels(self) -> Mapping[int, Connection]:
        """Topics, by their number in this file."""

    @property
    def span(self) -> tuple[int, int] | None:
        """Log time of the first and the last message [ns]; None without messages."""

    @property
    def unpacked_size(self) -> int:
        """[bytes] of all messages, uncompressed, at most; 0 where unknown."""

    def counts(self) -> dict[int, int]:
        """Return the number of messages of each channel."""

    def expected(self, start: int, stop: int) -> dict[int, int]:
        """Return how many messages channels have at most from ``start`` to ``stop`` [ns].

        Channels of which that is not known are left out.
        """

    def messages(self, channels: Collection[int], start: int, stop: int) -> Iterator[Message]:
        """Yield messages in the order of their log time [ns], from ``start`` to before ``stop``."""

    def batches(
        self,
        channels: Collection[int],
        start: int,
        stop: int,
        put: Callable[[Batch], None],
        *,
        compressed: bool = False,
    ) -> None:
        """Hand over messages many at a time, in any order of time.

        Args:
            channels: Numbers of the wanted ones.
            start: [ns] first log time.
            stop: [ns] log time before which to stop.
            put: Takes messages of one channel; perhaps called by several threads, but for a topic
                by one at once.
            compressed: Each message is compressed by itself: unpack it.

        """

    def log_times(self, channels: Collection[int]) -> Iterator[tuple[int, NDArray[np.int64]]]:
        """Yield numbers of channels with some of their log times [ns], as they lie in the file."""

    def pieces(self) -> Iterator[tuple[float, Iterator[Message]]]:
        """Yield parts of the file to save one by one, and which share of it lies before each.

        The messages of a part raise a DamagedBagError where it is damaged; the others go on.
        """

    def extras(self) -> Iterator[Attachment | Metadata | DamagedBagError]:
        """Yield attachments and named strings, and what is wrong with others."""

    def as_chunks(self) -> ChunkedFile | None:
        """Return the file as chunks that can be copied whole; None where it has no such things."""

    def require_whole(self) -> None:
        """Compare all bytes with a checksum of the whole file, where it has one.

        Raises:
            DamagedBagError: One of them is wrong.

        """

    def damage(self) -> Iterator[str]:
        """Yield what is wrong with the file, by reading all of it."""

    def require_open(self) -> None:
        """Refuse to go on once the file was closed.

        Raises:
            SourceError: It was.

        """

    def close(self) -> None:
        """Let go of the file; messages already read stay valid."""
