"""Write a bag: a folder of MCAP files with ``metadata.yaml``, as ``ros2 bag record`` leaves it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, final

import numpy as np

from agv_motion.bag.cdr import definitions
from agv_motion.bag.chunk_limits import chunk_limits
from agv_motion.bag.finished_files import FinishedFiles
from agv_motion.bag.mcap.together import FEW, Together
from agv_motion.bag.mcap.writer import McapWriter
from agv_motion.bag.metadata import FileSummary, Topic
from agv_motion.bag.quality_of_service import OfferedQos
from agv_motion.errors import ConfigurationError, SignalError, SourceError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import TracebackType

    from agv_motion.bag.mcap.records import Attachment, Metadata

DEFAULT_QOS = (OfferedQos(),)


@final
class BagWriter:
    """Writes messages into a new bag; safe against a crash but for the chunk being filled.

    A chunk is written when it is full or when its messages span ``chunk_duration``. The writer
    reads no clock: call :meth:`flush` every second or so to bound what a power cut can take.
    """

    def __init__(
        self,
        path: str | Path,
        *,
        compression: str = 'zstd',
        chunk_size: int = 1 << 20,
        chunk_duration: float = 1.0,
        ros_distro: str = 'jazzy',
    ) -> None:
        """Create the folder and its first file.

        Args:
            path: Folder of the bag; it must not exist.
            compression: Of the chunks: 'zstd', 'lz4' or 'none'.
            chunk_size: A chunk is written when it has this many bytes, uncompressed.
            chunk_duration: [s] of log time, after which a chunk is written though not full.
            ros_distro: Name of the ROS distribution, for the metadata.

        Raises:
            ConfigurationError: An argument is out of range.
            SourceError: The folder exists, or cannot be made.

        """
        self._limits = chunk_limits(chunk_size, chunk_duration)
        self.path = Path(path)
        self.discarded = 0
        """messages that found no room on a full disk"""
        self._compression = '' if compression == 'none' else compression
        self._finished = FinishedFiles(self.path, ros_distro)
        self._number = 0
        try:
            self.path.mkdir(parents=True)
            self._file = self._open_next()
        except OSError as error:
            msg = f'bag {self.path} cannot be written ({error.strerror}): choose a new folder'
            raise SourceError(msg) from error

    def add_topic(
        self,
        name: str,
        message_type: str,
        definition: str | None = None,
        *,
        type_hash: str | None = None,
        qos: Sequence[OfferedQos] = DEFAULT_QOS,
    ) -> int:
        """Return a handle with which messages of this topic are written.

        Args:
            name: Such as ``/cmd_vel``.
            message_type: Such as ``geometry_msgs/msg/TwistStamped``.
            definition: Full text of the type; None looks up the installed one.
            type_hash: ``RIHS01_...``; None takes that of the installed type with the definition.
            qos: Quality of service of each publisher.

        Raises:
            ConfigurationError: The topic is there already, or the type is not installed.

        """
        if definition is None:
            definition, known_hash = definitions.installed(message_type)
            type_hash = known_hash if type_hash is None else type_hash
        return self.add(Topic(name, message_type, definition, type_hash or '', tuple(qos)))

    def add(self, topic: Topic) -> int:
        """Return a handle for a topic that is described as another bag describes it.

        Raises:
            ConfigurationError: The topic is there already.

        """
        if (topic.name, topic.type) in ((t.name, t.type) for t in self._finished.topics):
            msg = f'topic {topic.name} is in bag {self.path} already: add it once, keep the handle'
            raise ConfigurationError(msg)
        handle = self._file.add_topic(topic)
        self._finished.add_topic(topic)
        return handle

    def write(
        self, topic: int, stamp: int, data: bytes, publish: int | None = None, sequence: int = 0
    ) -> None:
        """Append a message.

        Args:
            topic: Handle from :meth:`add_topic`.
            stamp: [ns] log time: when the message was received.
            data: The message in CDR, its four bytes of header included.
            publish: [ns] when it was sent; None means ``stamp``.
            sequence: Number the sender gave it; rosbag2 writes 0.

        Raises:
            SignalError: A number does not fit its field.
            OSError: The disk is full or failed; the file is as it was before the chunk.

        """
        file, limits = self._file, self._limits
        file.write(topic, stamp, data, stamp if publish is None else publish, sequence)
        if file.chunk_size >= limits.size or stamp - file.chunk_start >= limits.span:
            file.flush()

    def write_several(
        self, topics: Sequence[int], stamps: Sequence[int], data: Sequence[bytes]
    ) -> None:
        """Append messages: faster than one by one where many share a chunk, and the same bytes.

        Args:
            topics: (n,) handles from :meth:`add_topic`.
            stamps: (n,) log times, which are the publish times too [ns].
            data: (n,) messages in CDR, their headers included.

        Raises:
            SignalError: A stamp does not fit its field.
            OSError: The disk is full or failed; the file is as it was before the chunk.

        """
        if data and not 0 <= min(stamps) <= max(stamps) < 2**64:
            msg = (
                f'log times from {min(stamps)} to {max(stamps)}: expected nanoseconds in [0, 2^64)'
            )
            raise SignalError(msg)
        columns, first = None, 0
        while first < len(data):
            if self._file.waiting < FEW:
                self.write(topics[first], stamps[first], data[first])
                first += 1
            else:
                columns = columns or Together(topics, stamps, data)
                first = self._fill(columns, first)

    def _fill(self, messages: Together, first: int) -> int:
        """Write messages into the present chunk until it is full; return the first one left."""
        file, count = self._file, len(messages.data)
        room = self._limits.size - file.chunk_size
        full = int(np.searchsorted(messages.ends, messages.begins[first] + room))
        full = messages.first_from(first, min(full, count), file.chunk_start + self._limits.span)
        part = slice(first, full + 1)
        file.write_several(messages.channels[part], messages.stamps[part], messages.data[part])
        if full < count:
            file.flush()
        return full + 1

    def keep(self, extra: Attachment | Metadata) -> None:
        """Put an attachment, or named strings, into the present file.

        Raises:
            OSError: The disk is full or failed; the file is as it was before.

        """
        self._file.keep(extra)

    def flush(self, *, sync: bool = True) -> None:
        """Hand all messages to the system and, with ``sync``, to the disk: no power cut takes them.

        Raises:
            OSError: The disk is full or failed; what was not written waits for the next try.

        """
        self._file.flush()
        if sync:
            self._file.sync()

    @property
    def closed(self) -> bool:
        """Whether the bag is finished."""
        return self._file.closed

    @property
    def file_size(self) -> int:
        """Bytes of the present file."""
        return self._file.size

    @property
    def finished_files(self) -> list[FileSummary]:
        """The files before the present one, or all of a bag that is finished."""
        return [file.summary for file in self._finished.files]

    @property
    def counts(self) -> list[int]:
        """Messages of each topic that are in the bag, in the order in which topics were added."""
        return self._finished.counts(self._file)

    @property
    def deleted(self) -> list[int]:
        """Messages of each topic that were in files which :meth:`drop_oldest` deleted."""
        return self._finished.deleted

    def split(self) -> None:
        """Finish the present file and go on in a new one; handles stay as they are.

        Raises:
            OSError: The disk is full; the present file is whole all the same.

        """
        self._finish()
        self._file = self._open_next()
        for topic in self._finished.topics:
            self._file.add_topic(topic)
        self._finished.save(self._file)

    def drop_oldest(self) -> bool:
        """Delete the oldest finished file; return whether there was one."""
        return self._finished.drop_oldest(self._file)

    def close(self) -> None:
        """Finish the file and write ``metadata.yaml``.

        Raises:
            OSError: The disk is full. The bag is whole all the same: messages gave way until the
                summary had room, and ``discarded`` tells how many.

        """
        if not self._file.closed:
            self._finish()

    def _open_next(self) -> McapWriter:
        path = self.path / f'{self.path.name}_{self._number}.mcap'
        file = McapWriter(path, self._compression)
        self._number += 1
        return file

    def _finish(self) -> None:
        """Close the present file; on a full disk, without as many of its last chunks as needed."""
        failure = None
        try:
            self._file.flush()
        except OSError as error:
            failure = error
            self.discarded += self._file.waiting
            self._file.discard()
        while True:
            try:
                self._finished.close(self._file)
                break
            except OSError as error:
                failure = failure or error
                before = sum(self._file.counts)
                if not self._file.drop_chunk():
                    self._file.abandon()
                    raise
                self.discarded += before - sum(self._file.counts)
        if failure is not None:
            raise failure

    def __enter__(self) -> BagWriter:
        """Return the writer."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Finish the bag, also after an error: what was written is worth keeping."""
        self.close()
