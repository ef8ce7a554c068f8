"""One sqlite3 file of rosbag2, read by rosbags."""

from __future__ import annotations

from pathlib import Path
from sqlite3 import DatabaseError
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from rosbags.rosbag2 import Reader, ReaderError

from agv_motion.bag import definitions
from agv_motion.bag.connection import Connection, Message
from agv_motion.bag.damage import CLOSED
from agv_motion.bag.quality_of_service import OfferedQos, nanoseconds
from agv_motion.bag.sqlite_aside import set_aside
from agv_motion.errors import ConfigurationError, SourceError

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from agv_motion.bag.damage import DamagedBagError

_UNREADABLE = (ReaderError, OSError, ValueError, KeyError, TypeError, DatabaseError)


class SqliteFile:
    """Reads a ``.db3`` file; definitions that it lacks are taken from the installed types."""

    def __init__(self, path: Path) -> None:
        """Open the file.

        Raises:
            SourceError: It cannot be opened, or is no bag.

        """
        self.path = path
        self.problems: list[DamagedBagError] = []
        self.indexed = self.counted = True
        self._closed = False
        self._folder = TemporaryDirectory()
        try:
            self._reader = Reader(set_aside(path, Path(self._folder.name)))
            self._reader.open()
        except _UNREADABLE as error:
            self._folder.cleanup()
            if isinstance(error, SourceError):
                raise
            reason = str(error).replace(self._folder.name, str(path.parent))
            msg = f'{path} cannot be read as a bag in sqlite3: {reason}; agv bag recover may help'
            raise SourceError(msg) from error
        self._by_id = {c.id: c for c in self._reader.connections}
        self.channels = {c.id: _connection(c) for c in self._reader.connections}

    @property
    def span(self) -> tuple[int, int] | None:
        """Log time of the first and the last message [ns]; None without messages."""
        self.require_open()
        if not self._reader.message_count:
            return None
        return self._reader.start_time, self._reader.end_time - 1

    def counts(self) -> dict[int, int]:
        """Return the number of messages of each channel."""
        self.require_open()
        return {c.id: c.msgcount for c in self._reader.connections}

    def messages(self, channels: Collection[int], start: int, stop: int) -> Iterator[Message]:
        """Yield messages in the order of their log time [ns], from ``start`` to before ``stop``."""
        self.require_open()
        wanted = [self._by_id[number] for number in channels]
        limit = 2**63 - 1
        if not wanted or start > limit:
            return
        rows = self._reader.messages(wanted, max(start, -limit), min(stop, limit))
        try:
            for connection, stamp, data in rows:
                yield Message(self.channels[connection.id], stamp, data, stamp, 0)
        except Exception as error:
            if type(error).__module__.partition('.')[0] != 'apsw':
                raise
            msg = f'{self.path} is damaged: {error}; agv bag recover saves what can be read'
            raise SourceError(msg) from error

    def require_open(self) -> None:
        """Refuse to go on once the file was closed.

        Raises:
            SourceError: It was.

        """
        if self._closed:
            raise SourceError(CLOSED.format(self.path))

    def close(self) -> None:
        """Let go of the file."""
        self._closed = True
        self._reader.close()
        self._folder.cleanup()


def _connection(found: Any) -> Connection:
    text, encoding = (
        found.msgdef.data,
        'ros2msg' if found.msgdef.format.name == 'MSG' else 'ros2idl',
    )
    if not text:
        encoding = ''
        try:
            text, encoding = definitions.installed(found.msgtype).text, 'ros2msg'
        except ConfigurationError:
            text = ''
    profiles = tuple(_profile(profile) for profile in found.ext.offered_qos_profiles)
    form = found.ext.serialization_format
    return Connection(found.topic, found.msgtype, text, encoding, form, found.digest, profiles)


def _profile(qos: Any) -> OfferedQos:
    """Return a profile of rosbags in our words."""
    times = (qos.deadline, qos.lifespan, qos.liveliness_lease_duration)
    limits = [nanoseconds({'sec': t.sec, 'nsec': t.nsec}) for t in times]
    words = (qos.reliability, qos.durability, qos.history, qos.liveliness)
    return OfferedQos(qos.depth, *(word.name.lower() for word in words), *limits)
