"""One sqlite3 file of rosbag2, of any version of its tables."""

from __future__ import annotations

import sqlite3
from contextlib import ExitStack, contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.bag.cdr import definitions
from agv_motion.bag.columns.message_batches import of_messages
from agv_motion.bag.connection import Connection, Message
from agv_motion.bag.damage import CLOSED
from agv_motion.bag.quality_of_service import OfferedQos
from agv_motion.bag.sqlite.aside import set_aside
from agv_motion.errors import ConfigurationError, SourceError

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator

    from numpy.typing import NDArray

    from agv_motion.bag.columns.batch import Batch
    from agv_motion.bag.damage import DamagedBagError
    from agv_motion.bag.mcap.records import Attachment, Metadata

LATEST = 2**63 - 1
"""[ns] Last time that sqlite3 can hold."""
_TOPIC = ('id', 'name', 'type', 'serialization_format')
_LATER = ('offered_qos_profiles', 'type_description_hash')
"""Columns that topics have since Foxy and since Jazzy."""
_WHOLE = "typeof(timestamp) = 'integer' and timestamp >= 0 and typeof(data) = 'blob'"
"""What a row must be; sqlite3 takes anything into any column."""


class SqliteFile:
    """Reads a ``.db3`` file; definitions that it lacks are taken from the installed types."""

    indexed = counted = True
    unpacked_size = 0
    """[bytes] unknown"""

    def __init__(self, path: Path, unpacked: Path | None = None) -> None:
        """Open the file.

        Args:
            path: The file.
            unpacked: Where it lies unpacked, if it is compressed as a whole.

        Raises:
            SourceError: It cannot be opened, or is no bag.

        """
        self.path = path
        self.problems: list[SourceError] = []
        self._closed = False
        self._held = ExitStack()
        """the open database, and the folder that it is set aside in"""
        try:
            with self._told():
                folder = self._held.enter_context(TemporaryDirectory())
                aside = set_aside(unpacked or path, Path(folder))
                address = f'{aside.absolute().as_uri()}?mode=ro&immutable=1'
                self._base = sqlite3.connect(address, uri=True, check_same_thread=False)
                self._held.callback(self._base.close)
                self._base.text_factory = _text
                self.channels = self._topics()
                self._counts = self._counted()
        except BaseException:
            self._held.close()
            raise

    @property
    def span(self) -> tuple[int, int] | None:
        """Log time of the first and the last message [ns]; None without messages."""
        self.require_open()
        spans = [times for count, *times in self._counts.values() if count]
        if not spans:
            return None
        return min(first for first, _ in spans), max(last for _, last in spans)

    def counts(self) -> dict[int, int]:
        """Return the number of messages of each channel."""
        self.require_open()
        return {number: count for number, (count, *_) in self._counts.items()}

    def messages(self, channels: Collection[int], start: int, stop: int) -> Iterator[Message]:
        """Yield messages in the order of their log time [ns], from ``start`` to before ``stop``."""
        self.require_open()
        if not channels or start > LATEST:
            return
        among = ', '.join(str(int(number)) for number in channels)
        query = (
            f'select topic_id, timestamp, data from messages where topic_id in ({among}) and '  # noqa: S608 - whole numbers
            f'timestamp between ? and ? and {_WHOLE} order by timestamp, rowid'
        )
        with self._told():
            for number, stamp, data in self._base.execute(query, (start, min(stop - 1, LATEST))):
                yield Message(self.channels[number], stamp, data, stamp, 0)

    def batches(
        self,
        channels: Collection[int],
        start: int,
        stop: int,
        put: Callable[[Batch], None],
        *,
        compressed: bool = False,
    ) -> None:
        """Hand over messages many at a time; see :class:`Storage`."""
        for batch in of_messages(self, channels, start, stop, compressed=compressed):
            put(batch)

    def log_times(self, channels: Collection[int]) -> Iterator[tuple[int, NDArray[np.int64]]]:
        """Yield numbers of channels with their log times [ns], in order."""
        for number in channels:
            times = (message.stamp for message in self.messages([number], 0, LATEST))
            yield number, np.fromiter(times, np.int64)

    def pieces(self) -> Iterator[tuple[float, Iterator[Message]]]:
        """Yield all messages as one part, half of the work being done."""
        yield 0.5, self.messages(list(self.channels), 0, LATEST)

    def expected(self, start: int, stop: int) -> dict[int, int]:  # noqa: ARG002 - as Storage
        """Return no number: to count them is to read them."""
        return {}

    def extras(self) -> Iterator[Attachment | Metadata | DamagedBagError]:
        """Yield nothing: such a file has no room for more than messages."""
        return iter(())

    def as_chunks(self) -> None:
        """Return nothing: its messages lie one by one."""

    def require_whole(self) -> None:
        """Do nothing: it has no checksum."""

    def damage(self) -> Iterator[str]:
        """Yield nothing: it has no CRC, and what is no message is among ``problems``."""
        return iter(())

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
        self._held.close()

    @contextmanager
    def _told(self) -> Iterator[None]:
        """Tell what sqlite3 does not like of the file, with its name."""
        try:
            yield
        except (sqlite3.Error, OSError, OverflowError) as error:
            if isinstance(error, SourceError):
                raise
            self.require_open()
            msg = (
                f'{self.path} cannot be read as a bag in sqlite3: {error}; agv bag recover saves '
                'what can be read'
            )
            raise SourceError(msg) from error

    def _columns(self, table: str) -> set[str]:
        return {row[1] for row in self._base.execute(f'pragma table_info({table})')}

    def _topics(self) -> dict[int, Connection]:
        """Return the topics by number; those that are none are a problem."""
        there = self._columns('topics')
        if not (there >= set(_TOPIC) and self._columns('messages') >= {'topic_id', 'timestamp'}):
            msg = f'{self.path} is a database, but no bag: it lacks the tables topics or messages'
            raise SourceError(msg)
        names = [*_TOPIC, *(name for name in _LATER if name in there)]
        kinds = self._definitions()
        found: dict[int, Connection] = {}
        for row in self._base.execute(f'select {", ".join(names)} from topics order by id'):  # noqa: S608 - names of ours
            told = dict(zip(names, row, strict=True))
            if all(isinstance(told[name], str) for name in _TOPIC[1:]):
                found[told['id']] = _connection(told, *kinds.get(told['type'], ('', '')))
        return found

    def _definitions(self) -> dict[str, tuple[str, str]]:
        """Return text and encoding of the types that the file defines."""
        names = 'topic_type', 'encoded_message_definition', 'encoding'
        if not self._columns('message_definitions') >= set(names):
            return {}
        rows = self._base.execute(f'select {", ".join(names)} from message_definitions')  # noqa: S608 - names of ours
        return {kind: (str(text or ''), str(encoding or '')) for kind, text, encoding in rows}

    def _counted(self) -> dict[int, tuple[int, int, int]]:
        """Return number, first and last time [ns] of the messages of each topic."""
        counts = dict.fromkeys(self.channels, (0, 0, 0))
        rows = self._base.execute(
            'select topic_id, count(*), min(timestamp), max(timestamp) from messages '  # noqa: S608 - words of ours
            f'where {_WHOLE} group by topic_id'
        )
        counts |= {number: tuple(others) for number, *others in rows if number in counts}
        (every,) = self._base.execute('select count(*) from messages').fetchone()
        lost = every - sum(count for count, *_ in counts.values())
        if lost:
            self.problems.append(SourceError(
                f'{self.path}, table messages: {lost} of {every} rows are no messages: they lack '
                'a topic, a time or their data; the others are read'
            ))  # fmt: skip
        return counts


def _text(data: bytes) -> str:
    return data.decode(errors='replace')


def _connection(told: dict[str, Any], definition: str, encoding: str) -> Connection:
    kind, digest = told['type'], told.get('type_description_hash') or ''
    if not definition:
        encoding = ''
        try:
            definition, encoding = definitions.installed(kind).text, 'ros2msg'
        except ConfigurationError:
            definition = ''
    profiles = OfferedQos.from_yaml(str(told.get('offered_qos_profiles') or ''))
    form = told['serialization_format']
    return Connection(told['name'], kind, definition, encoding, form, digest, profiles)
