"""What the bags for `fuzz_commands.py` are made of: recordings, and what became of them."""

from __future__ import annotations

import io
import random
from functools import cache
from math import cos, sin
from struct import pack
from typing import TYPE_CHECKING, NamedTuple

from geometry_msgs.msg import PoseWithCovarianceStamped, TwistStamped
from mcap.writer import CompressionType, IndexType, Writer
from sensor_msgs.msg import JointState

from agv_motion.bag.cdr.definitions import installed
from agv_motion.bag.metadata import Topic
from agv_motion.bag.writer import BagWriter
from agv_motion.ros.cdr import codec
from agv_motion.ros.messages import stamp_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

START = 1_434_366_000_000_000_000
"""[ns] log time of the first message"""


class Sent(NamedTuple):
    """A message that was written."""

    topic: Topic
    stamp: int
    data: bytes
    publish: int
    sequence: int = 0


class Case(NamedTuple):
    """A bag, and what is known of it."""

    path: Path
    messages: Sequence[Sent] | None = None
    """what was written before the damage, or what is in it; None: it is no bag"""
    valid: bool = False
    """whether nothing is wrong with it, however odd it is"""
    place: str = ''
    """what an error must tell besides the file, as a regular expression"""
    close: Callable[[], object] = int
    """ends what the case holds, such as a lock"""


Maker = 'Callable[[Path, random.Random], Case]'


def topic(name: str, kind: str, definition: str = '', **others: str) -> Topic:
    """Return a topic without more about it than its type."""
    return Topic(name, kind, definition, '', (), **others)


@cache
def small() -> tuple[Sent, ...]:
    """Return two dozen messages of two topics."""
    numbers = topic('/a', 'std_msgs/msg/Float64', 'float64 data')
    texts = topic('/b', 'std_msgs/msg/String', 'string data')
    found = []
    for i in range(12):
        stamp = START + i * 10**8
        found.append(Sent(numbers, stamp, b'\0\1\0\0' + pack('<d', i), stamp - 5, i + 1))
        text = b'\0\1\0\0' + pack('<I', 5) + b'%04d\0' % i
        found.append(Sent(texts, stamp + 1000, text, stamp, i + 1))
    return tuple(found)


@cache
def drive() -> tuple[Sent, ...]:
    """Return 40 s of a differential robot that turns both ways, with its places and commands."""
    rng = random.Random(5)  # noqa: S311
    kinds = JointState, PoseWithCovarianceStamped, TwistStamped
    names = '/wheels/state', '/fix', '/cmd_vel'
    words = [f'{kind.__module__.partition(".")[0]}/msg/{kind.__name__}' for kind in kinds]
    topics = [topic(n, w, installed(w).text) for n, w in zip(names, words, strict=True)]
    found, x, y, heading, angles = [], 0.0, 0.0, 0.0, [0.0, 0.0]
    for i in range(400):
        stamp = START + i * 10**8
        turn = 0.8 * (-1) ** (i // 50) * 0.1
        x, y, heading = x + 0.03 * cos(heading), y + 0.03 * sin(heading), heading + turn
        angles = [
            angles[0] + (0.03 - turn * 0.155) / 0.05,
            angles[1] + (0.03 + turn * 0.155) / 0.05,
        ]
        state = JointState(name=['left_wheel', 'right_wheel'], position=angles)
        fix, command = PoseWithCovarianceStamped(), TwistStamped()
        fix.pose.pose.position.x, fix.pose.pose.position.y = x + rng.gauss(0, 0.01), y
        fix.pose.pose.orientation.z, fix.pose.pose.orientation.w = (
            sin(heading / 2),
            cos(heading / 2),
        )
        fix.pose.covariance[0] = fix.pose.covariance[7] = fix.pose.covariance[35] = 1e-4
        command.twist.linear.x, command.twist.angular.z = 0.3, turn * 10
        for k, message in enumerate((state, fix, command)):
            if i % (1, 10, 5)[k] == 0:
                message.header.stamp = stamp_of(stamp)
                data = codec(kinds[k]).encode(message)
                found.append(Sent(topics[k], stamp + k, data, stamp, i + 1))
    return tuple(found)


ALL = IndexType.ALL


def by_mcap(
    sent: Sequence[Sent],
    compression: str = 'zstd',
    chunk_size: int = 400,
    *,
    chunks: bool = True,
    index: IndexType = ALL,
    **options: bool,
) -> bytes:
    """Return a file as the writer of the MCAP project writes it, all CRCs in it."""
    stream = io.BytesIO()
    kinds = {'zstd': CompressionType.ZSTD, 'lz4': CompressionType.LZ4, '': CompressionType.NONE}
    given = {'enable_data_crcs': True, **options}
    writer = Writer(
        stream, chunk_size, kinds[compression], index, use_chunking=chunks, **given
    )  # fmt: skip
    writer.start('ros2', 'test')
    schemas: dict[tuple[str, str, str], int] = {}
    channels: dict[Topic, int] = {}
    for one in sent:
        t = one.topic
        key = t.type, t.definition_encoding, t.definition
        if t not in channels:
            bare = not (t.type or t.definition)
            if key not in schemas:
                schemas[key] = 0 if bare else writer.register_schema(*key[:2], key[2].encode())
            channels[t] = writer.register_channel(t.name, t.encoding, schemas[key])
        writer.add_message(channels[t], one.stamp, one.data, one.publish, one.sequence)
    writer.finish()
    return stream.getvalue()


def by_us(path: Path, sent: Sequence[Sent], **options: object) -> Path:
    """Write a bag as this package does; return it."""
    with BagWriter(path, **{'chunk_size': 400, **options}) as writer:
        handles: dict[Topic, int] = {}
        for one in sent:
            if one.topic not in handles:
                handles[one.topic] = writer.add(one.topic)
            handle = handles[one.topic]
            writer.write(handle, one.stamp, one.data, one.publish, one.sequence)
    return path


def file(folder: Path, data: bytes, name: str = 'bag.mcap') -> Path:
    """Write a file; return it."""
    path = folder / name
    path.write_bytes(data)
    return path
