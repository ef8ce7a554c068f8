"""Files of sqlite3 as rosbag2 writes them, of several versions, and what became of them."""

from __future__ import annotations

import random
import shutil
import sqlite3
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from odd_bags import Case, Maker, Sent, small

Spoil = Callable[[sqlite3.Connection, Path], object]
"""Returns what closes the database, if it is not to be closed at once, or is already"""

TOPICS = {
    1: 'id integer primary key, name text, type text, serialization_format text',
    3: 'id integer primary key, name text, type text, serialization_format text, '
    'offered_qos_profiles text',
    4: 'id integer primary key, name text, type text, serialization_format text, '
    'offered_qos_profiles text, type_description_hash text',
}


def database(path: Path, version: int = 4, sent: Sequence[Sent] = ()) -> sqlite3.Connection:
    """Write a file as rosbag2 of a version does; return it, open."""
    base = sqlite3.connect(path)
    base.execute(f'create table topics ({TOPICS[version]})')
    base.execute(
        'create table messages (id integer primary key, topic_id integer, timestamp integer, '
        'data blob)'
    )
    base.execute('create index timestamp_idx on messages (timestamp)')
    if version > 1:
        base.execute('create table schema (schema_version integer primary key, ros_distro text)')
        base.execute("insert into schema values (?, 'jazzy')", (version,))
    if version > 3:
        base.execute(
            'create table message_definitions (id integer primary key, topic_type text, '
            'encoding text, encoded_message_definition text, type_description_hash text)'
        )
    known: dict[object, int] = {}
    for one in sent or small():
        t = one.topic
        if t not in known:
            known[t] = len(known) + 1
            row = [known[t], t.name, t.type, t.encoding, '', '']
            fields = row[: {1: 4, 3: 5, 4: 6}[version]]
            marks = ', '.join('?' * len(fields))
            base.execute(f'insert into topics values ({marks})', fields)  # noqa: S608 - marks
            if version > 3:
                base.execute(
                    'insert into message_definitions values (?, ?, ?, ?, ?)',
                    (known[t], t.type, 'ros2msg', t.definition, ''),
                )
        base.execute(
            'insert into messages (topic_id, timestamp, data) values (?, ?, ?)',
            (known[t], one.stamp, one.data),
        )
    base.commit()
    return base


def sqlite_case(
    change: Callable[[sqlite3.Connection, Path], object] | None = None,
    *,
    version: int = 4,
    valid: bool = False,
    sent: Sequence[Sent] | None = (),
) -> Maker:
    """Return what makes a database and changes something in it."""

    def make(folder: Path, _: random.Random) -> Case:
        path = folder / 'bag.db3'
        base = database(path, version)
        kept: Callable[[], object] = int
        if change:
            kept = change(base, path) or int
        if kept is int:
            base.commit()
            base.close()
        # rosbag2's sqlite3 has one time and no number of a message
        whole = [one._replace(publish=one.stamp, sequence=0) for one in small()]
        return Case(path, whole if sent == () else sent, valid, close=kept)

    return make


def statement(*texts: str) -> Callable[[sqlite3.Connection, Path], None]:
    """Return what executes statements of SQL."""

    def change(base: sqlite3.Connection, _: Path) -> None:
        for text in texts:
            base.execute(text)

    return change


def _logged(base: sqlite3.Connection, path: Path) -> Callable[[], object]:
    """Leave half of the rows in a write-ahead log, as a killed recorder does."""
    rows = base.execute('select * from messages where id > 12').fetchall()
    base.execute('delete from messages where id > 12')
    base.commit()
    base.execute('pragma journal_mode = wal')
    base.executemany('insert into messages values (?, ?, ?, ?)', rows)
    base.commit()
    for end in ('', '-wal'):
        shutil.copy(f'{path}{end}', f'{path}{end}.kept')
    base.close()
    for end in ('', '-wal'):
        Path(f'{path}{end}.kept').rename(f'{path}{end}')
    return bool


def _locked(base: sqlite3.Connection, _: Path) -> Callable[[], object]:
    base.isolation_level = None
    base.execute('begin exclusive')
    return base.close


def spoil(act: Callable[[bytearray], object]) -> Spoil:
    """Return what changes the bytes of the file."""

    def change(base: sqlite3.Connection, path: Path) -> Callable[[], object]:
        base.close()
        data = bytearray(path.read_bytes())
        act(data)
        path.write_bytes(data)
        return bool  # it is closed

    return change


def cases() -> Iterator[tuple[str, Maker]]:
    """Yield all by name."""
    for version in TOPICS:
        yield f'sqlite3: schema {version}', sqlite_case(version=version, valid=True)
    yield 'sqlite3: a write-ahead log', sqlite_case(_logged, valid=True)
    yield 'sqlite3: locked', sqlite_case(_locked, valid=True)
    for size in (0, 50, 100, 1000, 5000, 9000, 20000):

        def cut(data: bytearray, size: int = size) -> None:
            del data[size:]

        yield f'sqlite3: cut off at {size}', sqlite_case(spoil(cut))
    for page in range(8):

        def zero(data: bytearray, page: int = page) -> None:
            begin = page * 4096
            data[begin : begin + 4096] = bytes(len(data[begin : begin + 4096]))

        yield f'sqlite3: zeros over page {page}', sqlite_case(spoil(zero))
    for seed in range(12):

        def flip(data: bytearray, seed: int = seed) -> None:
            rng = random.Random(seed)  # noqa: S311
            data[rng.randrange(100)] ^= 1 << rng.randrange(8)  # pages have no CRC

        yield f'sqlite3: a bit {seed}', sqlite_case(spoil(flip))
    statements = {
        'no messages': ('drop table messages',), 'no topics': ('drop table topics',),
        'nothing': ('delete from messages', 'delete from topics'),
        'a topic lost': ('delete from topics where id = 1',),
        'no data': ('update messages set data = null where id = 5',),
        'text for data': ("update messages set data = 'abc' where id = 5",),
        'no time': ('update messages set timestamp = null where id = 5',),
        'text for a time': ("update messages set timestamp = 'abc' where id = 5",),
        'a time below 0': ('update messages set timestamp = -5 where id = 5',),
        'no name': ('update topics set name = null where id = 1',),
        'quality of service 1': ("update topics set offered_qos_profiles = '{{{'",),
        'quality of service 2': ("update topics set offered_qos_profiles = '- depth: x'",),
        'quality of service 3': ("update topics set offered_qos_profiles = '- history: 99'",),
        'no definitions': ('drop table message_definitions',),
        'empty definitions': ('delete from message_definitions',),
        'schema 99': ('update schema set schema_version = 99',),
        'some other program': ('drop table messages', 'drop table topics', 'create table urls (a)'),
    }  # fmt: skip
    for name, texts in statements.items():
        sent = [] if name == 'nothing' else ()
        yield f'sqlite3: {name}', sqlite_case(statement(*texts), sent=sent)
    yield 'sqlite3 called .mcap', _called_mcap


def _called_mcap(folder: Path, rng: random.Random) -> Case:
    case = sqlite_case(valid=True)(folder, rng)
    return case._replace(path=case.path.rename(folder / 'bag.mcap'))
