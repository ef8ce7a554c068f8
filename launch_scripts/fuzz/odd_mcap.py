"""MCAP files that are damaged at every kind of record, or that are odd though nothing is wrong."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from struct import pack
from typing import TYPE_CHECKING

import lz4.frame
import odd_bags as bags
import zstandard
from mcap.writer import IndexType
from odd_bags import Case, Sent, by_mcap, drive, file, small

from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.record_parsing import walk

if TYPE_CHECKING:
    from pathlib import Path

Record = tuple[int, int, int, int]
"""opcode, where it begins, where its body begins, where it ends"""
Damage = Callable[[bytearray, random.Random, Record], None]

KINDS = {
    1: 'header', 2: 'footer', 3: 'schema', 4: 'channel', 5: 'message', 6: 'chunk',
    7: 'message index', 8: 'chunk index', 11: 'statistics', 14: 'summary offset', 15: 'data end',
}  # fmt: skip
LENGTHS = {
    'no length': 0, 'length 1': 1, 'length of 2 GiB': 2**31, 'length of 2^63': 2**63,
    'length of 2^64 - 1': 2**64 - 1,
}  # fmt: skip


def found(data: bytes) -> list[Record]:
    """Return the records of a whole file, those inside of chunks apart."""
    begin, size = len(records.MAGIC), records.PREFIX.size
    return [(o, at - size, at, end) for o, at, end in walk(data, begin, len(data))]


def flip(wrong: bytearray, rng: random.Random, record: Record) -> None:
    """Flip a bit in the body of a record."""
    wrong[rng.randrange(record[2], record[3])] ^= 1 << rng.randrange(8)


def flip_head(wrong: bytearray, rng: random.Random, record: Record) -> None:
    """Flip a bit in the first bytes of the body of a record."""
    wrong[rng.randrange(record[2], min(record[2] + 30, record[3]))] ^= 1 << rng.randrange(8)


def tear(wrong: bytearray, rng: random.Random, record: Record) -> None:
    """Cut the file off within a record."""
    del wrong[rng.randrange(record[1] + 1, record[3]) :]


def tear_before(wrong: bytearray, _: random.Random, record: Record) -> None:
    """Cut the file off before a record."""
    del wrong[record[1] :]


def lose(wrong: bytearray, _: random.Random, record: Record) -> None:
    """Take a record out."""
    del wrong[record[1] : record[3]]


def opcode(wrong: bytearray, rng: random.Random, record: Record) -> None:
    """Make another kind of a record."""
    wrong[record[1]] = rng.choice((0, 5, 6, 15, 16, 0x80, 0xFF))


def length_of(value: int) -> Damage:
    """Return what gives a record another length."""

    def lengthen(wrong: bytearray, _: random.Random, record: Record) -> None:
        wrong[record[1] + 1 : record[2]] = value.to_bytes(8, 'little')

    return lengthen


def zero(wrong: bytearray, _: random.Random, record: Record) -> None:
    """Write zeros where a page of a disk with this record was."""
    begin = record[1] // 512 * 512
    end = min(begin + 512, len(wrong))
    wrong[begin:end] = bytes(end - begin)


def damaged(
    data: Callable[[], bytes], sent: Sequence[Sent], kind: int, damage: Damage
) -> bags.Maker:
    """Return what damages a file at a record of one kind."""

    def make(folder: Path, rng: random.Random) -> Case:
        whole = data()
        wrong = bytearray(whole)
        damage(wrong, rng, rng.choice([r for r in found(whole) if r[0] == kind]))
        return Case(file(folder, bytes(wrong)), sent, place=r'byte \d+|begins with|empty')

    return make


def damages() -> Iterator[tuple[str, bags.Maker]]:
    """Yield damage of every kind at every kind of record, in files of several layouts."""
    sent, long = small(), drive()
    layouts = {
        'chunks': (lambda: by_mcap(sent, 'zstd'), sent),
        'no chunks': (lambda: by_mcap(sent, chunks=False), sent),
        'drive': (lambda: by_mcap(long, 'lz4', 1 << 14), long),
        'no index': (lambda: by_mcap(sent, index=IndexType.NONE), sent),
    }
    everywhere = {
        'a bit in': flip, 'a bit in the head of': flip_head, 'torn in': tear, 'lost': lose,
        'torn before': tear_before, 'another opcode of': opcode, 'zeros over': zero,
    }  # fmt: skip
    kinds = {name: {r[0] for r in found(data())} for name, (data, _) in layouts.items()}
    for layout, (data, which) in layouts.items():
        for number, name in KINDS.items():
            if number not in kinds[layout]:
                continue
            for what, damage in everywhere.items():
                few = layout in {'drive', 'no index'} and (
                    number not in {6, 7, 8} or damage is tear
                )
                if not few:
                    yield f'{layout}: {what} {name}', damaged(data, which, number, damage)
    for what, length in LENGTHS.items():
        for number in (3, 4, 6, 7, 8, 11):
            made = damaged(layouts['chunks'][0], sent, number, length_of(length))
            yield f'chunks: {KINDS[number]} with a {what}', made


def by_hand(sent: Sequence[Sent], around: Callable[[bytes, int], bytes] = lambda b, _: b) -> bytes:
    """Return a file of single records without summary; ``around`` wraps what a message needs."""
    parts = [records.MAGIC, records.header('ros2', '')]
    known: dict[object, int] = {}
    for number, one in enumerate(sent):
        t, body = one.topic, b''
        if t not in known:
            known[t] = len(known) + 1
            body += records.schema(
                records.Schema(known[t], t.type, t.definition_encoding, t.definition.encode())
            )
            body += records.channel(records.Channel(known[t], known[t], t.name, t.encoding, {}))
        body += message(known[t], one)
        parts.append(around(body, number))
    return b''.join((*parts, *ending()))


def message(channel: int, one: Sent) -> bytes:
    """Return the record of a message."""
    head = pack('<HIQQ', channel, one.sequence, one.stamp, one.publish)
    return records.record(records.MESSAGE, head, one.data)


def ending() -> tuple[bytes, bytes, bytes, bytes]:
    """Return the end of a file without summary."""
    return records.data_end(), records.footer_head(0, 0), records.checksum(0), records.MAGIC


def chunk(body: bytes, compression: str = '', times: tuple[int, int] = (0, 0)) -> bytes:
    """Return a chunk of some records, whatever its compression is called."""
    packed = {'zstd': zstandard.compress, 'lz4': lz4.frame.compress}.get(compression, bytes)(body)
    return records.chunk_head(times, (len(packed), len(body)), 0, compression) + packed


def odd(data: bytes, sent: Sequence[Sent], *, valid: bool = True, place: str = '') -> bags.Maker:
    """Return what writes a file."""
    return lambda folder, _: Case(file(folder, data), sent, valid, place)


def shapes() -> Iterator[tuple[str, bags.Maker]]:
    """Yield files of unusual shapes, most of them valid."""
    sent = small()
    plain, hand = by_mcap(sent), by_hand(sent)
    empty = chunk(b'')
    yield 'an empty chunk', odd(by_hand(sent, lambda b, i: empty * (i == 3) + b), sent)
    yield (
        'unknown records between',
        odd(by_hand(sent, lambda b, i: records.record(0x80 + i, b'???') + b), sent),
    )
    yield (
        'reserved records between',
        odd(by_hand(sent, lambda b, i: records.record(0x40 + i, b'???') + b), sent),
    )
    for name in ('', 'zstd', 'lz4'):
        yield (
            f'a chunk a message, {name or "bare"}',
            odd(by_hand(sent, lambda b, _, name=name: chunk(b, name)), sent),
        )
    for name in ('brotli', 'ZSTD', 'zstd ', 'snappy', 'ä'):
        wrong = by_hand(sent, lambda b, i, name=name: chunk(b, name if i > 5 else ''))
        yield f'compression {name!r}', odd(wrong, sent, valid=False, place=r'byte \d+')
    yield 'no summary', odd(hand, sent)
    yield 'only the magic', odd(records.MAGIC, [], valid=False, place='byte')
    yield 'the magic twice', odd(records.MAGIC * 2, [], valid=False, place='byte')
    head = records.MAGIC + records.header('', '')
    yield 'no messages', odd(head + b''.join(ending()), [])
    yield (
        'topics without messages',
        odd(
            by_hand(sent[:2], lambda b, _: b[: -len(b) + 20 + b.find(b'float64 data')]),
            [],
            valid=False,
        ),
    )
    yield 'no data end', odd(hand.replace(records.data_end(), b''), sent, valid=False)
    yield 'bytes after the end', odd(plain + bytes(100), sent, valid=False)
    yield 'two files in one', odd(plain + plain, sent, valid=False)
    yield (
        'chunks out of time',
        lambda folder, rng: Case(
            file(folder, by_mcap(rng.sample(sent, len(sent)))), sent, valid=True
        ),
    )
    yield (
        'stretches out of time',
        lambda folder, rng: Case(
            file(folder, by_mcap(rng.sample(sent, len(sent)), chunks=False)), sent, valid=True
        ),
    )
    unknown = by_hand(sent, lambda b, i: message(9, sent[0]) * (i == 5) + b)
    yield 'a channel nobody declares', odd(unknown, sent, valid=False, place=r'byte \d+|channel 9')
    bare = records.channel(records.Channel(7, 99, '/c', 'cdr', {}))
    missing = by_hand(sent, lambda b, i: bare * (i == 5) + b + message(7, sent[5]) * (i == 5))
    lacking = sent[5]._replace(topic=bags.topic('/c', '', definition_encoding=''))
    yield 'a schema nobody declares', odd(missing, [*sent[:6], lacking, *sent[6:]])
    again = records.channel(records.Channel(1, 1, '/a', 'cdr', {}))
    yield 'a channel told again', odd(by_hand(sent, lambda b, i: again * (i == 5) + b), sent)
    other = records.channel(records.Channel(1, 2, '/b', 'cdr', {}))
    yield (
        'a channel told otherwise',
        odd(by_hand(sent, lambda b, i: other * (i == 5) + b), sent, valid=False),
    )
    schema = records.schema(records.Schema(1, 'std_msgs/msg/Int8', 'ros2msg', b'int8 data'))
    yield (
        'a schema told otherwise',
        odd(by_hand(sent, lambda b, i: schema * (i == 5) + b), sent, valid=False),
    )
    zeroth = by_hand(sent).replace(
        records.channel(records.Channel(2, 2, '/b', 'cdr', {})),
        records.schema(records.Schema(0, 'x', '', b''))
        + records.channel(records.Channel(2, 2, '/b', 'cdr', {})),
    )
    yield 'a schema 0', odd(zeroth, sent, valid=False)


def totals() -> Iterator[tuple[str, bags.Maker]]:
    """Yield files whose statistics are not true."""
    sent = small()
    layout = (('messages', 0, 8), ('schemas', 8, 2), ('channels', 10, 4), ('chunks', 22, 4),
              ('start', 26, 8), ('end', 34, 8), ('size of the table', 42, 4), ('channel', 46, 2),
              ('messages of a channel', 48, 8))  # fmt: skip
    for name, at, size in layout:
        for value in (0, 2 ** (8 * size) - 1, 7):
            wrong = bytearray(by_mcap(sent, enable_crcs=False))
            (body,) = [r[2] for r in found(wrong) if r[0] == records.STATISTICS]
            wrong[body + at : body + at + size] = value.to_bytes(size, 'little')
            yield f'statistics: {name} {value}', odd(bytes(wrong), sent, valid=False)


def cases() -> Iterator[tuple[str, bags.Maker]]:
    """Yield all by name."""
    yield from damages()
    yield from shapes()
    yield from totals()
