"""Benchmarks of bags: writing beside rosbags, live recording, replay, and reprocessing a day."""

from __future__ import annotations

import math
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import Any

import rclpy
from geometry_msgs.msg import TwistStamped
from measure import Row, per_call
from rclpy.qos import QoSProfile
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore
from sensor_msgs.msg import JointState
from turret_peer import wpilib_command

from agv_motion.bag.playback.playback import Playback
from agv_motion.bag.playback.playback_parameters import PlaybackParameters
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.reprocess import Plan, reprocess
from agv_motion.reprocess.simulated_tree import NOON, record_simulated_tree
from agv_motion.ros.cdr import codec

MESSAGES = 200_000
LIVE_RATE, LIVE_SECONDS, LIVE_TOPICS = 10_000, 5, 8
TICKS = 12_000
"""in twenty minutes at 10 Hz"""
NODES = ('granier_probe', 'motion_generator', 'wheel_kinematics')
PLAN = Plan('tree.yaml', NODES, (('/pose', '/fix'),), 'zstd')
JOINTS, TWIST = 'sensor_msgs/msg/JointState', 'geometry_msgs/msg/TwistStamped'


def content(count: int) -> list[tuple[int, bytes]]:
    """Return messages of two kinds in turn: topic 0 or 1, and their bytes."""
    messages = []
    for i in range(count):
        values = [math.sin(i + k) for k in range(6)]
        if i % 2:
            twist = TwistStamped()
            twist.header.stamp.sec, twist.header.frame_id = i, 'base_link'
            twist.twist.linear.x, twist.twist.linear.y, twist.twist.angular.z = values[:3]
            messages.append((0, codec(TwistStamped).encode(twist)))
        else:
            joints = JointState(name=[f'turret_{k}' for k in range(6)], position=values)
            joints.velocity = values
            messages.append((1, codec(JointState).encode(joints)))
    return messages


def write_ours(path: Path, messages: list[tuple[int, bytes]]) -> float:
    """Return the time to write all messages into a bag [s]."""
    begin = time.perf_counter()
    with BagWriter(path) as writer:
        topics = [writer.add_topic('/twist', TWIST), writer.add_topic('/joints', JOINTS)]
        for i, (topic, data) in enumerate(messages):
            writer.write(topics[topic], i * 100_000, data)
    return time.perf_counter() - begin


def write_theirs(path: Path, messages: list[tuple[int, bytes]]) -> float:
    """Return the time that rosbags takes; it writes no CRCs."""
    store = get_typestore(Stores.ROS2_JAZZY)
    begin = time.perf_counter()
    writer = Writer(path, version=9, storage_plugin=StoragePlugin.MCAP)
    writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
    with writer:
        topics = [
            writer.add_connection('/twist', TWIST, typestore=store),
            writer.add_connection('/joints', JOINTS, typestore=store),
        ]
        for i, (topic, data) in enumerate(messages):
            writer.write(topics[topic], i * 100_000, data)
    return time.perf_counter() - begin


def writing_row(folder: Path) -> Row:
    """A message into a bag, zstd and CRCs on."""
    distinct = content(20_000)
    messages = [distinct[i % len(distinct)] for i in range(MESSAGES)]
    pairs = []
    for i in range(3):
        ours = write_ours(folder / f'ours_{i}', messages)
        pairs.append((ours, write_theirs(folder / f'theirs_{i}', messages)))
    ours, theirs = (median(column) / MESSAGES for column in zip(*pairs, strict=True))
    return Row('write a message, zstd, CRCs', ours, 'rosbags', theirs, 'ratio 1')


def live_row(folder: Path) -> Row:
    """Messages lost of 10,000 a second from the graph, over eight topics."""
    context = rclpy.Context()
    rclpy.init(context=context)
    node = rclpy.create_node('talker', context=context)
    topics = [
        node.create_publisher(TwistStamped, f'live_{i}', QoSProfile(depth=1000))
        for i in range(LIVE_TOPICS)
    ]
    command = ['record', '-e', '^/live_', '-o', str(folder / 'live'), '--keep-free', '0']
    recorder = subprocess.Popen(  # noqa: S603 - our own command
        [sys.executable, '-m', 'agv_motion.cli.main', *command], stdout=subprocess.DEVNULL
    )
    while not all(topic.get_subscription_count() for topic in topics):
        time.sleep(0.05)
    data = codec(TwistStamped).encode(TwistStamped())
    begin, sent = time.monotonic(), 0
    while sent < LIVE_RATE * LIVE_SECONDS:
        due = int((time.monotonic() - begin) * LIVE_RATE)
        for i in range(sent, min(due, LIVE_RATE * LIVE_SECONDS)):
            topics[i % LIVE_TOPICS].publish(data)
        sent = max(due, sent)
        time.sleep(0.001)
    time.sleep(1.0)
    recorder.send_signal(signal.SIGINT)
    recorder.wait()
    rclpy.shutdown(context=context)
    with BagReader(folder / 'live') as bag:
        lost = LIVE_RATE * LIVE_SECONDS - bag.message_count
    return Row('lost of 10,000 messages/s live, in 5 s', lost, target='0', plain=True)


def replay_row(folder: Path) -> Row:
    """How late 99 % of messages are at most, at 500 a second."""
    with BagWriter(folder / 'steady') as writer:
        topic = writer.add_topic('/twist', TWIST)
        for i, (_, data) in enumerate(content(2500)):
            writer.write(topic, i * 2_000_000, data)
    with BagReader(folder / 'steady') as bag:
        playback = Playback(bag, PlaybackParameters(), lambda _: None)
        playback.start()
        playback.finished.wait()
    return Row('replay at rate 1, lateness of 99 %', playback.lag.quantile(0.99), target='2 ms')


def reprocess_rows(folder: Path) -> list[Row]:
    """The tree at 10 Hz through three nodes, from ten minutes of noon and of night.

    What it takes to start, measured on a bag of one second, counts once a day. A tick is 0.1 s of
    the recording: a state of the turrets is read, from which odometry comes; the tree commands a
    twist, by the sap flow and the pose of every second; the turrets are commanded; each node looks
    at its inputs; all is written. It is told in processor time, beside WPILib's in the same minute.
    """
    took, messages, used, theirs = [], 0, [], []
    for name, begin, seconds in (
        ('first', NOON, 1),
        ('start', NOON, 1),
        ('noon', NOON, 600),
        ('night', NOON - 11 * 3600, 600),
    ):
        record_simulated_tree(folder / name, seconds, begin)
        theirs.append(per_call(wpilib_command, clock=time.process_time))
        processor = time.process_time()
        outcome = reprocess(folder / name, folder / f'{name}_again', PLAN)
        used.append(time.process_time() - processor)
        took.append(outcome.took)
        messages += (outcome.messages_in + outcome.messages_out) * (seconds > 1)
    start_up = took[1]
    running = sum(took[2:]) - 2.0 * start_up
    return [
        Row('reprocess a day at 10 Hz', start_up + running * 86_400 / 1200, target='10 s'),
        Row('reprocess a message, in or out', running / messages),
        Row(
            'reprocess a tick of 0.1 s',
            (sum(used[2:]) - 2.0 * used[1]) / TICKS,
            'robotpy-wpimath, one command',
            median(theirs),
            'ratio 8',
        ),
    ]


@contextmanager
def scratch() -> Any:
    """Yield a folder that is gone afterwards."""
    folder = Path(tempfile.mkdtemp(prefix='agv_motion_'))
    try:
        yield folder
    finally:
        shutil.rmtree(folder)


def rows() -> list[Row]:
    """Measure everything that has to do with recorded bags."""
    with scratch() as folder:
        return [
            writing_row(folder),
            live_row(folder),
            replay_row(folder),
            *reprocess_rows(folder),
        ]
