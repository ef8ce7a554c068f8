"""Save what can be read of a damaged bag into a new one, with its index rebuilt."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from agv_motion.bag.bag_files import find
from agv_motion.bag.columns.message_batches import unpack_message
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.editing.new_channels import topic_of
from agv_motion.bag.file_kind import SQLITE, kind
from agv_motion.bag.mcap.records import Attachment
from agv_motion.bag.reader import BagReader
from agv_motion.bag.sqlite.recovery import copy_readable
from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from agv_motion.bag.connection import Connection, Message
    from agv_motion.bag.storage import Storage
    from agv_motion.bag.writer import BagWriter


class Recovery:
    """Writes every message that can be read into a new bag, in the order of the files.

    Chunks that are damaged are left out; of one whose end is missing, all whole messages are saved.
    A second type of a topic goes on under the name of the topic and ``_2``.
    """

    def __init__(self, writer: BagWriter) -> None:
        """Keep the new bag, which stays open."""
        self._writer = writer
        self._handles: dict[tuple[str, ...], int] = {}
        self.messages = 0
        """that were saved"""
        self.missing = 0
        """messages of which the old bag tells, and that could not be saved"""
        self.problems: list[SourceError] = []
        """what is amiss in the old bag, each with file and byte"""

    def save(self, path: Path, progress: Callable[[float], None] = lambda _: None) -> None:
        """Save a bag.

        Args:
            path: The damaged bag: its folder, or a file.
            progress: Is told the share that is done.

        Raises:
            SourceError: There is no bag.

        """
        found = find(path)
        self.problems += found.problems
        for number, file in enumerate(found.paths):
            first = len(self.problems)
            with self._noting(SourceError), TemporaryDirectory() as folder:
                readable = file
                if kind(file) == SQLITE:
                    readable = Path(folder) / 'readable.db3'
                    self.problems += copy_readable(file, readable)
                with BagReader(readable) as bag:
                    self.problems += bag.problems
                    for share in self._saved(bag, packed=found.messages_compressed):
                        progress((number + share) / len(found.paths))
            self.problems[first:] = [_of(file, readable, p) for p in self.problems[first:]]

    @contextmanager
    def _noting(self, kind: type[SourceError]) -> Iterator[None]:
        """Take note of an error instead of stopping."""
        try:
            yield
        except kind as error:
            self.problems.append(error)

    def _saved(self, bag: BagReader, *, packed: bool) -> Iterator[float]:
        """Save one file, its messages packed or not; yield now and then the share that is done."""
        for connection in bag.connections:
            self._handle(connection)
        for file in bag.files:
            before = self.messages
            self._keep(file)
            for message, share in self._messages(file):
                with self._noting(DamagedBagError):
                    whole = unpack_message(message, file.path) if packed else message
                    topic = self._handle(message.connection)
                    self._writer.write(
                        topic, whole.stamp, whole.data, whole.publish, whole.sequence
                    )
                    self.messages += 1
                if not self.messages % 1000:
                    yield share
            if file.counted:
                told = sum(file.counts().values())
                self.missing += max(told - (self.messages - before), 0)

    def _keep(self, file: Storage) -> None:
        """Save attachments and named strings; those of rosbag2 are written anew."""
        for extra in file.extras():
            if isinstance(extra, DamagedBagError):
                self.problems.append(extra)
            elif isinstance(extra, Attachment) or extra.name != 'rosbag2':
                self._writer.keep(extra)

    def _handle(self, connection: Connection) -> int:
        """Return the topic in the new bag."""
        kind = connection.type, connection.definition, connection.definition_encoding
        key = connection.topic, connection.encoding, *kind
        if key not in self._handles:
            before = sum(topic == connection.topic for topic, *_ in self._handles)
            topic = topic_of(connection)
            if before:
                topic = topic._replace(name=f'{connection.topic}_{before + 1}')
            self._handles[key] = self._writer.add(topic)
        return self._handles[key]

    def _messages(self, file: Storage) -> Iterator[tuple[Message, float]]:
        """Yield what can be read of a file, and where in it that is, from 0 to 1."""
        for share, piece in file.pieces():
            with self._noting(DamagedBagError):
                for message in piece:
                    yield message, share


def _of(file: Path, readable: Path, problem: SourceError) -> SourceError:
    """Return a problem of what could be read of a file as one of the file."""
    told = str(problem)
    if file == readable or str(readable) not in told:
        return problem
    return SourceError(told.replace(str(readable), str(file)))
