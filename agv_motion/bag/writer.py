"""Write a bag: a folder of MCAP files with ``metadata.yaml``, as ``ros2 bag record`` leaves it."""

from __future__ import annotations

from math import inf, isfinite
from pathlib import Path
from typing import TYPE_CHECKING, final

from agv_motion.bag import definitions, metadata
from agv_motion.bag.mcap_writer import McapWriter
from agv_motion.bag.quality_of_service import OfferedQos
from agv_motion.errors import ConfigurationError, SourceError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import TracebackType

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
        if not (chunk_size >= 1 and chunk_duration > 0.0):
            msg = (
                f'chunk_size {chunk_size} and chunk_duration {chunk_duration}: '
                'both must be positive; 1 MiB and 1 s suit most'
            )
            raise ConfigurationError(msg)
        self.path = Path(path)
        self._ros_distro = ros_distro
        self._chunk_size = chunk_size
        self._chunk_span = int(chunk_duration * 1e9) if isfinite(chunk_duration) else inf
        self._topics: list[metadata.Topic] = []
        try:
            self.path.mkdir(parents=True)
            file = self.path / f'{self.path.name}_0.mcap'
            self._file = McapWriter(file, '' if compression == 'none' else compression)
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
        if any(topic.name == name for topic in self._topics):
            msg = f'topic {name} is in bag {self.path} already: add it once, keep the handle'
            raise ConfigurationError(msg)
        if definition is None:
            definition, known_hash = definitions.installed(message_type)
            type_hash = known_hash if type_hash is None else type_hash
        topic = metadata.Topic(name, message_type, definition, type_hash or '', tuple(qos))
        self._topics.append(topic)
        return self._file.add_channel(topic)

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
        file = self._file
        file.write(topic, stamp, data, stamp if publish is None else publish, sequence)
        if file.chunk_size >= self._chunk_size or stamp - file.chunk_start >= self._chunk_span:
            file.flush()

    def flush(self) -> None:
        """Bring all messages to the disk: after this, a power cut does not take them."""
        self._file.flush()
        self._file.sync()

    def close(self) -> None:
        """Finish the file and write ``metadata.yaml``."""
        self._file.flush()
        file = self._file
        name = file.path.name
        files = [metadata.FileSummary(name, file.start, file.end, sum(file.counts))]
        topics = zip(self._topics, file.counts, strict=True)
        description = metadata.describe(files, topics, self._ros_distro)
        file.close({'serialized_metadata': metadata.inside_mcap(description)})
        metadata.save(self.path, description)

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
