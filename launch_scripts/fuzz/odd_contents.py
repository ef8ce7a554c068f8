"""Bags that are whole, and whose messages, types, topics or times are out of the ordinary."""

from __future__ import annotations

from math import nan
from struct import pack
from typing import TYPE_CHECKING

from odd_bags import START, Case, Sent, by_mcap, by_us, file, small, topic

if TYPE_CHECKING:
    import random
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from odd_bags import Maker

DOUBLE = 'std_msgs/msg/Float64', 'float64 data'
STAMPED = (
    'std_msgs/Header header\nfloat64 data\n' + '=' * 80 + '\nMSG: std_msgs/Header\n'
    'builtin_interfaces/Time stamp\nstring frame_id\n' + '=' * 80
    + '\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n'
)  # fmt: skip


def number(value: float) -> bytes:
    """Return a message of std_msgs/Float64."""
    return b'\0\1\0\0' + pack('<d', value)


def stamped(sec: int, nanosec: int, value: float) -> bytes:
    """Return a message with a header."""
    return b'\0\1\0\0' + pack('<iIIxxxxd', sec, nanosec, 0, value)


def odd(*sent: Sent, ours: bool = False) -> Maker:
    """Return what puts some messages beside the usual ones."""

    def make(folder: Path, _: random.Random) -> Case:
        messages = sorted((*small(), *sent), key=lambda one: one.stamp)
        if ours:
            return Case(by_us(folder / 'bag', messages), messages, valid=True)
        return Case(file(folder, by_mcap(messages)), messages, valid=True)

    return make


def one(kind: str, definition: str, *data: bytes, name: str = '/odd', **more: str) -> Maker:
    """Return what puts messages of one odd topic beside the usual ones."""
    about = topic(name, kind, definition, **more)
    return odd(*(Sent(about, START + i * 10**8, d, START + i) for i, d in enumerate(data)))


def encodings() -> Iterator[tuple[str, Maker]]:
    """Yield types and messages that are not, or not quite, those of ROS 2."""
    for name in ('json', 'protobuf', 'ros1', 'cbor', 'text', '', 'flatbuffer', 'CDR', 'cdr_le'):
        yield f'messages in {name!r}', one('Odd', '{}', b'{"a": 1}', encoding=name)
    for name in ('foo', 'protobuf', 'ros1msg', 'jsonschema', 'flatbuffer', 'omgidl', ''):
        yield f'schema in {name!r}', one(*DOUBLE, number(1.0), definition_encoding=name)
    yield 'no schema', one('', '', number(1.0), definition_encoding='')
    texts = {
        'none': '', 'comments': '# nothing', 'no field': 'float64', 'nonsense': '\0\x01???',
        'a type that is not there': 'a_msgs/Missing x', 'wstring': 'wstring data',
        'html': '<html><body>404</body></html>', 'service': 'float64 a\n---\nfloat64 b',
        'crlf': 'float64 data\r\n', 'bounded': 'float64[<=4] data', 'constants': 'float64 X=1\n',
        'defaults': 'float64 data 1.5', 'long double': 'float128 data',
        'idl': 'struct X { long a; };',
        'itself': 'std_msgs/Float64 data', 'emoji': 'float64 data # \U0001f332',
    }  # fmt: skip
    for name, text in texts.items():
        yield f'definition: {name}', one(DOUBLE[0], text, number(1.0))
    for name in ('std_msgs/Float64', 'Float64', 'std_msgs::msg::Float64', '', 'a/b/c/d', 'ä/msg/Ö'):
        yield f'type {name!r}', one(name, DOUBLE[1], number(1.0))


def payloads() -> Iterator[tuple[str, Maker]]:
    """Yield messages that are not as their type says, or are so in an unusual way."""
    form, value = DOUBLE, pack('<d', 1.5)
    yield 'a message of no bytes', one(*form, b'')
    for size in (1, 3, 4, 5, 11):
        yield f'a message of {size} bytes', one(*form, number(1.5)[:size])
    yield 'a long message', one(*form, number(1.5) + bytes(100))
    yield 'padded to four', one(*form, number(1.5) + bytes(3))
    yield 'big-endian', one(*form, b'\0\0\0\0' + pack('>d', 1.5))
    yield 'both orders', one(*form, number(1.0), b'\0\0\0\0' + pack('>d', 2.0), number(3.0))
    for head in (2, 3, 6, 7, 8, 9, 10, 11, 0xFFFF, 0x100):
        yield f'encapsulation {head:#06x}', one(*form, pack('>HH', head, 0) + value)
    yield 'options in the head', one(*form, b'\0\1\0\3' + value)
    text = 'std_msgs/msg/String', 'string data'
    bad = {
        'a length of 4 GiB': pack('<I', 2**32 - 1), 'no final zero': pack('<I', 4) + b'abcd',
        'length 0': pack('<I', 0), 'no UTF-8': pack('<I', 3) + b'\xff\xfe\0',
        'a zero within': pack('<I', 5) + b'a\0bc\0', 'lines': pack('<I', 6) + b'a\nb\r\n\0',
    }  # fmt: skip
    for name, data in bad.items():
        yield f'string: {name}', one(*text, b'\0\1\0\0' + data)
    many = 'a_msgs/msg/Many', 'float64[] data'
    for count in (0, 1, 2, 2**28, 2**32 - 1):
        data = b'\0\1\0\0' + pack('<I', count) + bytes(12)
        yield f'sequence of {count} in 16 bytes', one(*many, data)
    yield 'ragged', one(*many, *(b'\0\1\0\0' + pack('<II', n, 0) + bytes(8 * n) for n in (1, 3, 2)))
    yield 'a bool of 2', one('std_msgs/msg/Bool', 'bool data', b'\0\1\0\0\2')
    yield 'a byte of 255', one('std_msgs/msg/Byte', 'byte data', b'\0\1\0\0\xff')
    yield 'nothing in it', one('std_msgs/msg/Empty', '', b'\0\1\0\0\0')
    yield 'NaN', one(*form, number(nan), number(1.0))
    yield 'infinite', one(*form, number(float('inf')), number(-float('inf')))
    stamps = {
        'stamp 0': (0, 0), 'stamp before 1970': (-5, 0), 'nanoseconds beyond': (5, 2**32 - 1),
        'stamp of 2038': (2**31 - 1, 999_999_999),
    }  # fmt: skip
    for name, (sec, nanosec) in stamps.items():
        yield name, one('a_msgs/msg/S', STAMPED, stamped(sec, nanosec, 1.0), stamped(9, 0, 2.0))
    yield (
        'stamps that go back',
        one('a_msgs/msg/S', STAMPED, *(stamped(9 - i, 0, i) for i in range(5))),
    )


def names_and_times() -> Iterator[tuple[str, Maker]]:
    """Yield topics of odd names and numbers, and messages at odd times."""
    names = (
        '',
        '/',
        'a',
        '/a b',
        '/ä',
        '/\U0001f332',
        '/a\nb',
        '/[a]',
        '/../../etc',
        '/' + 'x' * 300,
    )
    for name in names:
        yield f'topic {name[:20]!r}', one(*DOUBLE, number(1.0), name=name)
    yield (
        'one file name for two',
        odd(
            *(Sent(topic(n, *DOUBLE), START, number(1.0), START) for n in ('/x/y', '/x__y', '/X/Y'))
        ),
    )
    yield (
        '300 topics',
        odd(*(Sent(topic(f'/t{i}', *DOUBLE), START + i, number(i), START) for i in range(300))),
    )
    for ours in (False, True):
        other = Sent(
            topic('/a', 'std_msgs/msg/Int32', 'int32 data'), START + 5, b'\0\1\0\0\7\0\0\0', 0
        )
        yield f'one topic of two types{" by us" * ours}', odd(other, ours=ours)
    again = Sent(topic('/a', DOUBLE[0], 'float64 data # or so'), START + 5, number(1.0), 0)
    yield 'one type told in two ways', odd(again)
    times = {
        '0': (0, 1, 2), 'all the same': (START, START, START), 'above 2^63': (2**63, 2**63 + 5),
        'the last of all': (2**64 - 1, 2**64 - 2), 'both ends': (0, 2**64 - 1),
        'just below 2^63': (2**63 - 2, 2**63 - 1),
    }  # fmt: skip
    about = topic('/a', *DOUBLE)
    for name, stamps in times.items():
        yield f'log times: {name}', alone([Sent(about, t, number(1.0), t) for t in sorted(stamps)])
    yield 'log times going back', _back
    yield 'publish times of 0', odd(Sent(topic('/odd', *DOUBLE), START, number(1.0), 0))
    yield 'one message', alone([Sent(about, START, number(1.0), START)])


def alone(sent: Sequence[Sent]) -> Maker:
    """Return what writes these messages and no others."""
    return lambda folder, _: Case(file(folder, by_mcap(sent)), sent, valid=True)


def _back(folder: Path, _: random.Random) -> Case:
    return Case(file(folder, by_mcap(small()[::-1], chunk_size=100)), small(), valid=True)


def cases() -> Iterator[tuple[str, Maker]]:
    """Yield all by name."""
    yield from encodings()
    yield from payloads()
    yield from names_and_times()
