"""The commands that write, each with what stands in its folder before, and what it is to leave."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from math import cos, sin
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from geometry_msgs.msg import PoseWithCovarianceStamped
from sensor_msgs.msg import JointState

from agv_motion.bag.writer import BagWriter
from agv_motion.odometry.columns import pose_columns
from agv_motion.reprocess.simulated_tree import record_simulated_tree
from agv_motion.ros.cdr import codec
from agv_motion.ros.messages import stamp_of

if TYPE_CHECKING:
    from collections.abc import Iterator
    from contextlib import AbstractContextManager

SECOND = 1_000_000_000
NOON = 1434366000 * SECOND
ROOT = Path(__file__).resolve().parents[2]


class Case(NamedTuple):
    """A command, and what is known of it."""

    name: str
    command: tuple[str, ...]
    before: tuple[tuple[str, bytes], ...] = ()
    """files in its folder that are somebody's own, or an earlier run's"""
    together: tuple[str, ...] = ()
    """folders that appear whole or not at all"""
    status: int = 0
    """of an undisturbed run"""
    bag: str = ''
    """folder of a bag that no two runs make alike: judged by readers, not by bytes"""
    forked: bool = True
    """whether it runs in a fork of the rig: one process, without a graph"""
    worker: bool = False
    """whether it has workers that may be killed"""
    beside: str = ''
    """what runs beside it: 'talker' or 'cluster'"""
    copies: tuple[str, ...] = ()
    """bags among the sources that are copied into its folder before"""
    indexed: bool = False
    """whether it leaves an index of the bags in its folder, which is judged by what it tells"""
    debts: tuple[str, ...] = ()
    """command that saves the events that an ended recorder owes"""
    again: bool = True
    """whether the same command completes what was ended; else it refuses, and touches nothing"""


OLD = b'of the day before'


def cases(sources: Path, cluster: str) -> list[Case]:
    """Return every command that writes.

    Args:
        sources: Folder that `prepare` has filled.
        cluster: Address of a Dask scheduler; empty: none.

    """
    walk, walks, torn, drive = (
        str(sources / name) for name in ('walk', 'walks', 'torn.mcap', 'drive')
    )
    notes, picture = ('tables/notes.txt', OLD), (('a.png', OLD),)
    again = ('reprocess', walks, 'results', '-m', 'pose:=fix', '-n', 'wheel_kinematics')
    results = tuple(f'results/{name}' for name in 'abc')
    found = [
        Case('bag recover', ('bag', 'recover', torn, 'saved'), (), ('saved',), status=1),
        Case('bag cut', ('bag', 'cut', walk, 'new', '--from', '5', '--to', '15'), (), ('new',)),
        Case('bag filter', ('bag', 'filter', walk, 'new', '--topics', '/odom'), (), ('new',)),
        Case('bag split', ('bag', 'split', walk, 'new', '-d', '7'), (), ('new',)),
        Case('bag merge', ('bag', 'merge', walk, walk, 'new'), (), ('new',)),
        Case('bag convert', ('bag', 'convert', walk, 'new'), (), ('new',)),
        Case('bag compress', ('bag', 'compress', walk, 'new', '--compression', 'lz4'), (),
             ('new',)),
        Case('bag index', ('bag', 'index', '.'), copies=('walk', 'torn.mcap'), indexed=True),
        Case('bag find', ('bag', 'find', '.', '--where', '/cmd_vel/twist/linear/x > -9'),
             copies=('walk',), indexed=True),
        Case('bag filter -j 2', ('bag', 'filter', walks, 'new', '--topics', '/odom', '-j', '2'), (),
             tuple(f'new/{name}' for name in 'abc'), forked=False, worker=True),
        Case('bag compress -j 2', ('bag', 'compress', walks, 'new', '--compression', 'lz4',
                                   '-j', '2'), (), tuple(f'new/{name}' for name in 'abc'),
             forked=False, worker=True),
        Case('bag export csv', ('bag', 'export', walk, 'tables', '--topics', '/odom', '--topics',
                                '/fix', '--topics', '/cmd_vel'), (notes,)),
        Case('bag export parquet', ('bag', 'export', walk, 'tables', '--topics', '/odom',
                                    '--topics', '/fix', '-f', 'parquet'), (notes,)),
        Case('bag plot', ('bag', 'plot', walk, '/odom/pose/pose', '-o', 'a.png'), picture),
        Case('plot', ('plot', walk, '-o', 'a.png'), picture),
        Case('calibrate', ('calibrate', drive, '-o', 'a.yaml'), (('a.yaml', OLD),)),
        Case('route', ('route', 'route_example.yaml', '--plot', 'a.png'), picture),
        Case('sequence', ('sequence', 'sequence_example.yaml', '--dry-run', '--plot', 'a.png'),
             picture),
        Case('drive', ('drive', 'to', '2', '1', '90', '--dry-run', '--plot', 'a.png'),
             picture),
        Case('reprocess', ('reprocess', f'{walks}/a', 'result', '-m', 'pose:=fix'),
             together=('result',)),
        Case('reprocess -j 2', (*again, '-j', '2'), (), results, forked=False, worker=True),
        Case('record', ('record', '-a', '-o', 'bag', '-d', '0.25', '--duration', '2'), bag='bag',
             forked=False, beside='talker', again=False),
        Case('record a ring', ('record', '-a', '-o', 'bag', '-d', '0.2', '--keep-files', '2',
                               '--duration', '2'),
             bag='bag', forked=False, beside='talker', again=False),
        Case('record --trigger', ('record', '-a', '-o', 'bag', '-d', '0.25', '--duration', '2',
                                  '--trigger', '/number/data ~ 99.', '--before', '0.5', '--after',
                                  '0.3'),
             bag='bag', forked=False, beside='talker', again=False,
             debts=('record', '-a', '-o', 'later', '--duration', '0.5')),
        Case('demo', ('demo', '--minutes', '0.3', '--no-page', '--output', '.'),
             (('notes.txt', OLD),),
             bag='bag', forked=False),
        Case('demo omni', ('demo', 'omni', '--no-page', '--output', '.'),
             (('notes.txt', OLD),), bag='bag',
             forked=False),
        Case('demo differential',
             ('demo', 'differential', '--time-factor', '20', '--no-page', '--output', '.'),
             (('notes.txt', OLD),), bag='bag', forked=False),
    ]  # fmt: skip
    if cluster:
        command = (*again, '--scheduler', cluster)
        found.append(Case('reprocess on a cluster', command, (), results, forked=False,
                          worker=True, beside='cluster'))  # fmt: skip
    return found


def prepare(sources: Path, chosen: list[Case]) -> None:
    """Make the bags that the chosen commands read."""
    read = ' '.join(
        word
        for case in chosen
        for word in (*case.command, *(str(sources / name) for name in case.copies))
    )
    sources.mkdir()
    if str(sources / 'walk') in read or str(sources / 'torn') in read:
        record_simulated_tree(sources / 'walk', 20)
        whole = (sources / 'walk' / 'walk_0.mcap').read_bytes()
        (sources / 'torn.mcap').write_bytes(whole[: len(whole) * 3 // 4])
    for seed, name in enumerate('abc' if str(sources / 'walks') in read else '', 1):
        record_simulated_tree(sources / 'walks' / name, 20, seed=seed)
    if str(sources / 'drive') in read:
        _drive(sources / 'drive')


def _drive(path: Path) -> None:
    """Record a differential drive with places, for the calibration."""
    rng = np.random.default_rng(2)
    way = np.zeros((3, 200))
    way[0], way[2] = 0.03, np.repeat(rng.uniform(-0.08, 0.08, 10), 20)
    turned = np.array([(way[0] - way[2] * 0.155) / 0.049, (way[0] + way[2] * 0.155) / 0.0505])
    angles = np.concatenate([np.zeros((2, 1)), np.cumsum(turned, axis=1)], axis=1)
    poses = pose_columns(way) + rng.normal(0.0, 0.01, (3, 201))
    with BagWriter(path) as bag:
        states = bag.add_topic('/wheels/state', 'sensor_msgs/msg/JointState')
        fixes = bag.add_topic('/fix', 'geometry_msgs/msg/PoseWithCovarianceStamped')
        for i, (left, right) in enumerate(angles.T.tolist()):
            time = 100 * SECOND + i * SECOND // 10
            state = JointState(name=['left_wheel', 'right_wheel'], position=[left, right])
            state.header.stamp = stamp_of(time)
            bag.write(states, time, codec(JointState).encode(state))
            if i % 10 == 0:
                fix = PoseWithCovarianceStamped()
                fix.header.stamp = stamp_of(time)
                x, y, heading = poses[:, i].tolist()
                fix.pose.pose.position.x, fix.pose.pose.position.y = x, y
                fix.pose.pose.orientation.z = sin(heading / 2)
                fix.pose.pose.orientation.w = cos(heading / 2)
                fix.pose.covariance[0] = fix.pose.covariance[7] = 1e-4
                fix.pose.covariance[35] = 1e-4
                bag.write(fixes, time, codec(PoseWithCovarianceStamped).encode(fix))


TALKER = """
import threading, rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node('talker')
latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
node.create_publisher(String, 'map', latched).publish(String(data='map' * 1000))
speak = node.create_publisher(String, 'number', QoSProfile(depth=1000)).publish
pace, i = threading.Event(), 0
print('ready', flush=True)
while True:
    speak(String(data=f'{i:08d}' + '.' * 300))
    i += 1
    pace.wait(0.004)
"""


@contextmanager
def talker() -> Iterator[None]:
    """Let a node speak as long as the block runs."""
    command = [sys.executable, '-c', TALKER]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:  # noqa: S603
        try:
            assert process.stdout is not None
            process.stdout.readline()
            yield
        finally:
            process.kill()


@contextmanager
def cluster(folder: Path) -> Iterator[str]:
    """Yield the address of a Dask scheduler with two workers, which come again when killed."""
    dask, file = [sys.executable, '-m'], folder / 'scheduler.json'
    options = ['--no-dashboard', '--host', '127.0.0.1', '--port', '0']
    options += ['--scheduler-file', str(file)]
    quiet = {'stdout': subprocess.DEVNULL, 'stderr': subprocess.DEVNULL, 'cwd': folder,
             'env': os.environ | {'PYTHONPATH': str(ROOT)}}  # fmt: skip
    started = [subprocess.Popen([*dask, 'distributed.cli.dask_scheduler', *options], **quiet)]  # noqa: S603
    worker = ['distributed.cli.dask_worker', '--scheduler-file', str(file), '--nthreads', '1',
              '--nworkers', '2', '--no-dashboard']  # fmt: skip
    started.append(subprocess.Popen([*dask, *worker], start_new_session=True, **quiet))  # noqa: S603
    try:
        while not file.exists() or not file.stat().st_size:
            time.sleep(0.05)
        yield json.loads(file.read_text())['address']
    finally:
        os.killpg(started[1].pid, signal.SIGTERM)
        started[0].terminate()
        for process in started:
            process.wait(60)


def beside(case: Case) -> AbstractContextManager[None]:
    """Return what runs beside a command."""
    return talker() if case.beside == 'talker' else _nothing()


@contextmanager
def _nothing() -> Iterator[None]:
    yield
