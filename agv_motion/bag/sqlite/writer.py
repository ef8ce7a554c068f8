"""One sqlite3 file in the making, with the tables of rosbag2 (version 4 of its schema, Jazzy)."""

from __future__ import annotations

import sqlite3
from typing import TYPE_CHECKING

from agv_motion.bag.quality_of_service import as_yaml

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from agv_motion.bag.metadata import Topic

_TABLES = """
create table schema(schema_version integer primary key, ros_distro text not null);
create table metadata(id integer primary key, metadata_version integer not null,
    metadata text not null);
create table topics(id integer primary key, name text not null, type text not null,
    serialization_format text not null, offered_qos_profiles text not null,
    type_description_hash text not null);
create table message_definitions(id integer primary key, topic_type text not null,
    encoding text not null, encoded_message_definition text not null,
    type_description_hash text not null);
create table messages(id integer primary key, topic_id integer not null,
    timestamp integer not null, data blob not null);
"""


class SqliteWriter:
    """Writes messages into one new file.

    No journal is kept and nothing waits for the disk: the file is made beside its place, and is
    moved there when it is whole.
    """

    def __init__(self, path: Path, ros_distro: str = 'jazzy') -> None:
        """Create the file, which must not exist."""
        path.open('xb').close()
        self.path = path
        self._base = sqlite3.connect(path, isolation_level=None)
        self._types: set[str] = set()
        self._topics = 0
        for setting in ('journal_mode = off', 'synchronous = off', 'page_size = 65536'):
            self._base.execute(f'pragma {setting}')
        self._base.executescript(f'begin; {_TABLES}')
        self._base.execute('insert into schema values (4, ?)', (ros_distro,))

    def add_topic(self, topic: Topic) -> int:
        """Return the number of a new topic."""
        self._topics += 1
        row = self._topics, topic.name, topic.type, topic.encoding, as_yaml(topic.qos), topic.hash
        self._base.execute('insert into topics values (?, ?, ?, ?, ?, ?)', row)
        if topic.type not in self._types and topic.definition:
            self._types.add(topic.type)
            definition = topic.definition.encode(errors='surrogateescape').decode(errors='replace')
            about = topic.type, topic.definition_encoding, definition, topic.hash
            self._base.execute('insert into message_definitions values (null, ?, ?, ?, ?)', about)
        return self._topics

    def write(self, rows: Iterable[tuple[int, int, bytes]]) -> None:
        """Append messages: topic, log time [ns] and data of each.

        Raises:
            sqlite3.Error: The disk takes no more, or a time does not fit.

        """
        self._base.executemany('insert into messages values (null, ?, ?, ?)', rows)

    def close(self, description: str) -> None:
        """Write the index of the times and what describes the bag; close."""
        self._base.execute('insert into metadata values (1, 9, ?)', (description,))
        self._base.execute('create index timestamp_idx on messages (timestamp asc)')
        self._base.execute('commit')
        self._base.close()

    def abandon(self) -> None:
        """Let go of the file."""
        self._base.close()
