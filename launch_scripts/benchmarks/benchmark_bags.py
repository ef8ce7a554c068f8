"""Benchmarks of reading bags: a mixed bag into columns, beside rosbags and the readers of mcap."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
import time
from functools import partial
from itertools import islice
from math import inf
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

import mcap_codec
import numpy as np
from geometry_msgs.msg import TwistStamped, Vector3Stamped
from mcap.reader import make_reader
from mcap.records import Chunk
from mcap.stream_reader import StreamReader, get_chunk_data_stream
from mcap_ros2_support_fast.decoder import DecoderFactory
from measure import Row
from nav_msgs.msg import Odometry
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_typestore
from sensor_msgs.msg import JointState, LaserScan

from agv_motion.bag.columns.columns import read_topics
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.ros.cdr import codec as ros_codec
from agv_motion.ros.messages import type_name

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

MESSAGES = 1_000_000
SAMPLE = 100_000
"""messages that the slow peers read"""
ROUNDS = 5
KINDS = {'/twist': TwistStamped, '/joints': JointState, '/odom': Odometry, '/flow': Vector3Stamped}
NAMES = [f'turret_{i}_steering' for i in range(6)]
SELECTED = {
    '/twist': ['twist.linear', 'header.stamp'],
    '/joints': ['position'],
    '/odom': ['pose.pose.position', 'header.stamp'],
    '/flow': ['vector'],
}
MEBIBYTE = 1 << 20


def message(kind: Any, i: int, values: list[float]) -> Any:
    """Return a message of a kind that the robot could have sent at 100 Hz."""
    sent = kind()
    sent.header.frame_id = 'base_link'
    sent.header.stamp.sec, sent.header.stamp.nanosec = divmod(i * 10_000_000, 10**9)
    if kind is TwistStamped:
        sent.twist.linear.x, sent.twist.linear.y, sent.twist.angular.z = values[:3]
    elif kind is JointState:
        sent.name, sent.position, sent.velocity = NAMES, values[:6], values[6:12]
    elif kind is Odometry:
        sent.child_frame_id = 'odom'
        position, orientation = sent.pose.pose.position, sent.pose.pose.orientation
        position.x, position.y, orientation.z, orientation.w = values[:4]
        sent.pose.covariance[:12] = values
    elif kind is LaserScan:
        sent.ranges = values * 60
    else:
        sent.vector.x, sent.vector.y, sent.vector.z = values[:3]
    return sent


def write(path: Path, count: int) -> None:
    """Write ``count`` messages of four types in turn: zstd, CRCs, chunks of 1 MiB as elsewhere."""
    rng = np.random.default_rng(1)
    with BagWriter(path, chunk_duration=inf) as writer:
        kinds = [(writer.add_topic(topic, type_name(kind)), kind) for topic, kind in KINDS.items()]
        encode = {kind: ros_codec(kind).encode for kind in KINDS.values()}
        for i, values in enumerate(rng.normal(size=(count // 4, 12)).tolist()):
            for number, (topic, kind) in enumerate(kinds):
                data = encode[kind](message(kind, i, values))
                writer.write(topic, i * 10_000_000 + number, data)


def columns(
    path: Path, fields: Mapping[str, list[str]] | None = None, *, validate: bool = True
) -> None:
    """Read every message into columns; the peers do not compare CRCs, we do by default."""
    with BagReader(path, validate=validate) as bag:
        read_topics(bag, fields)


def rosbags(path: Path) -> None:
    """Decode the sample with rosbags."""
    store = get_typestore(Stores.ROS2_JAZZY)
    with Reader(path) as reader:
        for connection, _, data in islice(reader.messages(), SAMPLE):
            store.deserialize_cdr(data, connection.msgtype)


def mcap_fast(path: Path) -> None:
    """Decode the sample with mcap-ros2-support-fast."""
    with next(path.glob('*.mcap')).open('rb') as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        for _ in islice(reader.iter_decoded_messages(), SAMPLE):
            pass


def mcap_chunks(path: Path) -> None:
    """Decompress every chunk with mcap's reader, and look at nothing in it."""
    with next(path.glob('*.mcap')).open('rb') as file:
        for record in StreamReader(file, emit_chunks=True).records:
            if isinstance(record, Chunk):
                get_chunk_data_stream(record)


def peak(path: Path) -> float:
    """Return how much memory columns take at most, above 64 MiB, by their size."""
    code = 'import sys, benchmark_bags; benchmark_bags.weigh(sys.argv[1])'
    answer = subprocess.run(  # noqa: S603 - our own interpreter
        [sys.executable, '-c', code, str(path)],
        capture_output=True, text=True, check=True, cwd=Path(__file__).parent,
    )  # fmt: skip
    taken, returned = map(float, answer.stdout.split())
    return (taken - 64 * MEBIBYTE) / returned


def weigh(path: str) -> None:
    """Print the memory that reading took at its peak, and that of the columns [bytes]."""
    with BagReader(path) as bag:
        Path('/proc/self/clear_refs').write_text('5')  # the peak begins anew
        before = resident('VmRSS')
        found = read_topics(bag)
        taken = resident('VmHWM') - before
    size = sum(f.nbytes for topic in found.values() for f in topic.fields.values())
    print(taken, size + sum(topic.stamps.nbytes for topic in found.values()))


def resident(row: str) -> int:
    """Return memory of this process as the kernel tells it [bytes]."""
    status = Path('/proc/self/status').read_text()
    return int(status.partition(f'{row}:')[2].split()[0]) * 1024


def timed(act: Callable[[], None]) -> float:
    """Return the time of the second of two calls [s].

    A virtual machine takes memory that was free for a few seconds from its host again, page by
    page: the first call measures that.
    """
    act()
    begin = time.perf_counter()
    act()
    return time.perf_counter() - begin


def codec(path: Path) -> None:
    """Read the only topic of a bag with roboto-mcap-codec."""
    file = next(path.glob('*.mcap'))
    with file.open('rb') as data:

        def read(offset: int, length: int) -> bytes:
            data.seek(offset)
            return data.read(length)

        when = mcap_codec.TimestampSource('message_log_time')
        batches = mcap_codec.open_mcap_file(read, file.stat().st_size, timestamp=when)
        assert sum(batch.num_rows for batch in batches)


def write_alone(path: Path, kind: Any, count: int) -> None:
    """Write a bag of one topic."""
    rng = np.random.default_rng(1)
    with BagWriter(path, chunk_duration=inf) as writer:
        topic, encode = writer.add_topic('/alone', type_name(kind)), ros_codec(kind).encode
        for i, values in enumerate(rng.normal(size=(count, 12)).tolist()):
            writer.write(topic, i * 10_000_000, encode(message(kind, i, values)))


def codec_rows(folder: Path) -> list[Row]:
    """Read odometry and scans into columns, in turn with roboto-mcap-codec."""
    found = []
    for kind, count, target in (
        (Odometry, 200_000, 'ratio 0.31'),
        (LaserScan, 20_000, 'ratio 0.8'),
    ):
        bag = folder / kind.__name__
        write_alone(bag, kind, count)
        turns = [(timed(partial(columns, bag)), timed(partial(codec, bag))) for _ in range(ROUNDS)]
        ours, theirs = (median(times) / count for times in zip(*turns, strict=True))
        what = f'{kind.__name__} into columns'
        found.append(Row(what, ours, 'roboto-mcap-codec', theirs, target))
    return found


def rows() -> list[Row]:
    """Read one bag of a million messages in every way, in turn."""
    folder = Path(tempfile.mkdtemp(prefix='agv_motion_'))
    try:
        bag = folder / 'mixed'
        write(bag, MESSAGES)
        ways: list[tuple[Callable[[], None], int]] = [
            (lambda: columns(bag), MESSAGES),
            (lambda: columns(bag, SELECTED), MESSAGES),
            (lambda: columns(bag, validate=False), MESSAGES),
            (lambda: rosbags(bag), SAMPLE),
            (lambda: mcap_fast(bag), SAMPLE),
            (lambda: mcap_chunks(bag), MESSAGES),
        ]
        turns = [[timed(way) / count for way, count in ways] for _ in range(ROUNDS)]
        ours, some, unchecked, theirs, fast, chunks = map(median, zip(*turns, strict=True))
        what = 'a message into columns'
        return [
            Row(what, ours, 'rosbags', theirs, '250 ns, ratio 0.04'),
            Row(what, ours, 'mcap-ros2-support-fast', fast, 'ratio 0.029'),
            Row(what, ours, 'mcap, chunks unpacked', chunks, 'ratio 0.67'),
            Row('..., CRCs not compared', unchecked, 'rosbags', theirs, 'ratio 0.04'),
            Row('..., 10 of its fields', some, 'all fields', ours, 'ratio 1'),
            Row('peak memory - 64 MiB, by columns', peak(bag), target='1.5', plain=True),
            *codec_rows(folder),
        ]
    finally:
        shutil.rmtree(folder)
