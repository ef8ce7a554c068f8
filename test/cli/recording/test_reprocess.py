"""`agv reprocess` over recordings: the decisions of the live nodes, the same bytes every time."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
from math import nan
from pathlib import Path

import pytest

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import TwistStamped
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

from agv_motion.bag.editing.diff import Tolerance, diff
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import ConfigurationError
from agv_motion.nodes.catalogue import available
from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.nodes.localization import Localization
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.omni_kinematics import OmniKinematics
from agv_motion.nodes.omni_simulator import OmniSimulator
from agv_motion.nodes.simulator import Simulator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.reprocess.one_bag import Plan, Transcript, reprocess
from agv_motion.reprocess.recorded import LIVE_ONLY, node_class, parameters
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.in_process_topic import InProcessListener, InProcessRowPublisher
from agv_motion.ros.messages import stamp_of

SECOND = 1_000_000_000
NOON = 1434366000 * SECOND
PLAN = Plan(
    'tree.yaml',
    ('granier_probe', 'motion_generator', 'wheel_kinematics'),
    (('/pose', '/fix'),),
    'zstd',
)


def record(path, seconds, seed=1):
    """Write what the whole tree says in ``seconds`` before a June noon."""
    with BagWriter(path) as writer:
        transcript = Transcript(writer)
        graph = InProcessGraph(transcript.record, NOON)
        for kind, name in (
            (GranierProbe, 'granier_probe'),
            (MotionGenerator, 'motion_generator'),
            (WheelKinematics, 'wheel_kinematics'),
            (Simulator, 'simulator'),
        ):
            given = parameters('tree.yaml', name)
            if name == 'simulator':
                given |= {'seed': seed, 'start_time': '2015-06-15T11:00:00'}
            InProcessNode(graph, kind, given, {'/pose': '/fix'})
        graph.start()
        graph.run(NOON + seconds * SECOND)
        graph.stop()
        transcript.flush()
    return path


@pytest.fixture(scope='module')
def recorded(tmp_path_factory):
    """Return a folder of three recordings, the second of them spoilt."""
    folder = tmp_path_factory.mktemp('recorded')
    record(folder / 'a', 60)
    record(folder / 'c', 30, seed=2)
    (folder / 'b').mkdir()
    (folder / 'b' / 'b_0.mcap').write_bytes(b'no bag')
    return folder


def content(folder):
    """Return the bytes of all files of a folder."""
    return {path.relative_to(folder): path.read_bytes() for path in sorted(folder.rglob('*.mcap'))}


def test_what_was_decided_is_decided_again(recorded, tmp_path):
    outcome = reprocess(recorded / 'a', tmp_path / 'out', PLAN)
    assert not outcome.failure
    with BagReader(recorded / 'a') as before, BagReader(tmp_path / 'out') as after:
        after.require(['/cmd_vel', '/turrets/command', '/odom', '/granier/sap_flow'])
        for topic in diff(before, after, sorted(after.topics), Tolerance()):
            assert topic.same, topic
        assert any(
            m.data != next(after.messages(['/cmd_vel'])).data for m in after.messages(['/cmd_vel'])
        )


def one_by_one(monkeypatch, *, rows=True):
    """Let nothing be known before it comes, and where asked let no row go as it is."""
    monkeypatch.setattr(InProcessListener, 'look_ahead', lambda *_: None)
    if rows:
        monkeypatch.setattr(InProcessRowPublisher, 'goes_as_it_is', lambda _: False)


@pytest.mark.parametrize('rows', [False, True])
def test_rows_many_together_lead_to_the_same_bytes(recorded, tmp_path, monkeypatch, rows):
    reprocess(recorded / 'a', tmp_path / 'together' / 'out', PLAN)
    one_by_one(monkeypatch, rows=rows)
    reprocess(recorded / 'a', tmp_path / 'apart' / 'out', PLAN)
    assert content(tmp_path / 'together') == content(tmp_path / 'apart')


def test_states_that_cannot_be_taken_together_are_taken_one_by_one(recorded, tmp_path, monkeypatch):
    joints = codec(JointState)
    with BagReader(recorded / 'a') as bag, BagWriter(tmp_path / 'odd') as writer:
        topics = {name: writer.add_topic(name, c.type) for name, c in bag.topics.items()}
        for i, message in enumerate(bag.messages()):
            data = message.data
            if message.connection.topic == '/turrets/state' and i > 2000:
                state = joints.decode(data)
                if i < 2100:
                    state.position[1] = nan
                elif i > 3000:
                    state.name.reverse()
                    state.position.reverse()
                    state.velocity.reverse()
                data = joints.encode(state)
            writer.write(topics[message.connection.topic], message.stamp, data)
    together = reprocess(tmp_path / 'odd', tmp_path / 'together' / 'out', PLAN)
    one_by_one(monkeypatch)
    apart = reprocess(tmp_path / 'odd', tmp_path / 'apart' / 'out', PLAN)
    assert content(tmp_path / 'together') == content(tmp_path / 'apart')
    assert together.complaints == apart.complaints
    assert any('must be finite' in text for text in together.complaints)


def test_another_configuration_decides_otherwise(recorded, tmp_path):
    reprocess(recorded / 'a', tmp_path / 'one', PLAN)
    tuned = tmp_path / 'tuned.yaml'
    tuned.write_text('/**/wheel_kinematics:\n  ros__parameters: {wheel_radius: 0.2}\n')
    only = PLAN._replace(config=str(tuned), nodes=('wheel_kinematics',))
    outcome = reprocess(recorded / 'a', tmp_path / 'two', only)
    assert not outcome.failure
    with BagReader(tmp_path / 'one') as one, BagReader(tmp_path / 'two') as two:
        assert '/cmd_vel' not in two.topics
        (commands,) = diff(one, two, ['/turrets/command'], Tolerance(1e-9))
    worst = commands.worst['velocity[4]']
    assert 0.0 < worst.second < 0.8 * worst.first  # a larger wheel turns more slowly


def test_the_same_bytes_from_two_runs_and_from_two_workers(alone, recorded, tmp_path):
    for name, workers in (('one', 1), ('two', 2)):
        status, out, errors = alone(
            'reprocess',
            recorded,
            tmp_path / name / 'out',
            '-m',
            'pose:=fix',
            '-j',
            workers,
            cold=True,
        )
        assert status == 1
        assert f'error: {recorded / "b"}' in errors
        assert str(recorded / 'a') in out
        assert 'Traceback' not in errors
    found = content(tmp_path / 'one')
    assert len(found) == 2
    assert found == content(tmp_path / 'two')


@pytest.fixture
def cluster(tmp_path, wait_until):
    """Return the address of a real scheduler with a worker process."""
    pytest.importorskip('distributed')
    dask = [sys.executable, '-m', 'distributed.cli.dask_scheduler']
    address_file = tmp_path / 'scheduler.json'
    options = ['--no-dashboard', '--host', '127.0.0.1', '--port', '0']
    quiet = {'stdout': subprocess.DEVNULL, 'stderr': subprocess.DEVNULL, 'cwd': tmp_path}
    quiet['env'] = os.environ | {'PYTHONPATH': str(Path(__file__).parents[3])}
    scheduler = subprocess.Popen(  # noqa: S603 - our own interpreter
        [*dask, *options, '--scheduler-file', str(address_file)], **quiet
    )
    worker = subprocess.Popen(  # noqa: S603
        [sys.executable, '-m', 'distributed.cli.dask_worker', '--scheduler-file',
         str(address_file), '--nthreads', '1', '--no-dashboard'], **quiet,
    )  # fmt: skip
    try:
        wait_until(lambda: address_file.exists() and address_file.stat().st_size)
        yield json.loads(address_file.read_text())['address']
    finally:
        for process in (worker, scheduler):
            process.terminate()
            process.wait(60)


def test_a_cluster_gives_the_same_bytes(alone, recorded, tmp_path, cluster):
    status, _, errors = alone(
        'reprocess', recorded, tmp_path / 'far' / 'out', '-m', 'pose:=fix', '--scheduler', cluster,
        timeout=120,
    )  # fmt: skip
    assert status == 1
    assert f'error: {recorded / "b"}' in errors
    for name in ('a', 'c'):
        reprocess(recorded / name, tmp_path / 'near' / 'out' / name, PLAN)
    assert content(tmp_path / 'far') == content(tmp_path / 'near')


def finished(folder):
    """Return the whole results below a folder, by name, with their bytes."""
    return {p.name: content(p) for p in sorted(folder.iterdir()) if not p.name.startswith('.')}


def descendants(pid):
    """Return the processes that ``pid`` has started, and those that these have."""
    found = Path(f'/proc/{pid}/task/{pid}/children').read_text()
    return [c for child in map(int, found.split()) for c in (child, *descendants(child))]


def gone(pid):
    """Return whether a process has ended."""
    try:
        return ') Z' in Path(f'/proc/{pid}/stat').read_text()
    except OSError:
        return True


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL])
def test_a_signal_ends_all_workers_at_once_and_a_rerun_completes(
    alone, recorded, tmp_path, wait_until, number
):
    """Ctrl-C goes to all processes of a terminal; kill to the first one alone."""
    sources = tmp_path / 'in'
    sources.mkdir()
    for name in 'abc':
        shutil.copytree(recorded / 'c', sources / name)
    out = tmp_path / 'out'
    command = ('reprocess', sources, out, '-m', 'pose:=fix', '-j', 2)
    process = alone.start(*command, start_new_session=True)
    wait_until(lambda: len(list(out.glob('.*.unfinished-*/*/*.mcap'))) == 2)
    started = descendants(process.pid)
    assert len(started) >= 2
    (os.killpg if number == signal.SIGINT else os.kill)(process.pid, number)
    _, errors = process.communicate(timeout=60)
    wait_until(lambda: all(map(gone, started)), 10)
    assert process.returncode == (-9 if number == signal.SIGKILL else 130)
    assert 'Traceback' not in errors
    before = finished(out)
    assert len(before) < 3
    if number != signal.SIGKILL:
        assert not list(out.glob('.*'))
    if number in {signal.SIGTERM, signal.SIGHUP}:
        return  # as SIGINT
    status, told, _ = alone(*command)
    assert status == 0
    assert told.count('there already') == len(before)
    assert finished(out).keys() == set('abc')
    sizes = {sum(map(len, files.values())) for files in finished(out).values()}
    assert len(sizes) == 1
    assert not list(out.glob('.*'))


def test_a_killed_worker_takes_one_bag_with_it_and_no_other(alone, recorded, tmp_path, wait_until):
    sources, out = tmp_path / 'in', tmp_path / 'out'
    sources.mkdir()
    for name in 'abc':
        shutil.copytree(recorded / 'c', sources / name)
    process = alone.start('reprocess', sources, out, '-m', 'pose:=fix', '-j', 2)
    wait_until(lambda: list(out.glob('.a.unfinished-*/a/*.mcap')))
    (lock,) = out.glob('.a.unfinished-*')
    holder = next(
        pid
        for pid in descendants(process.pid)
        if any(os.path.realpath(fd) == str(lock) for fd in Path(f'/proc/{pid}/fd').iterdir())
    )
    os.kill(holder, signal.SIGKILL)
    _, errors = process.communicate(timeout=120)
    assert process.returncode == 1
    assert f'{sources / "a"}: its worker ended: exit status -9; run again' in errors
    assert finished(out).keys() == {'b', 'c'}
    assert not list(out.glob('.*'))


def test_a_result_is_made_anew_for_another_configuration_only(recorded, tmp_path):
    out = tmp_path / 'out'
    assert not reprocess(recorded / 'c', out, PLAN).made_before
    before = content(out)
    assert reprocess(recorded / 'c', out, PLAN).made_before
    tuned = tmp_path / 'tuned.yaml'
    tuned.write_text('/**/wheel_kinematics:\n  ros__parameters: {wheel_radius: 0.2}\n')
    for plan in (PLAN._replace(config=str(tuned)), PLAN._replace(remap=())):
        assert 'File exists' in reprocess(recorded / 'c', out, plan).failure
    assert 'File exists' in reprocess(recorded / 'a', out, PLAN).failure
    assert content(out) == before


def test_a_failure_leaves_no_half_result(recorded, tmp_path):
    outcome = reprocess(
        recorded / 'a', tmp_path / 'out', PLAN._replace(remap=(('/path', '/path'),))
    )
    assert not outcome.failure
    shutil.rmtree(tmp_path / 'out')
    outcome = reprocess(recorded / 'a', tmp_path / 'out', PLAN._replace(nodes=('nothing',)))
    assert "no node 'nothing'" in outcome.failure
    assert not (tmp_path / 'out').exists()


def test_a_bag_that_has_lost_something_is_told_each_time_with_status_1(alone, recorded, tmp_path):
    (file,) = (recorded / 'c').glob('*.mcap')
    torn = tmp_path / 'torn.mcap'
    torn.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    for word in (' s ', 'there already'):
        status, out, errors = alone('reprocess', torn, tmp_path / 'out', '-n', 'wheel_kinematics')
        assert status == 1
        assert 'torn.mcap, byte ' in errors
        assert word in out


def test_every_node_that_can_be_without_a_graph_runs(recorded, tmp_path):
    nodes = tuple(name for name in available() if name not in LIVE_ONLY)
    assert {'sequence', 'route_follower', 'localization', 'ghost_trajectory'} <= set(nodes)
    for name in nodes:
        assert node_class(name).__name__
    quiet = Plan('', ('sequence', 'route_follower', 'ghost_trajectory'), (), 'zstd')
    outcome = reprocess(recorded / 'c', tmp_path / 'out', quiet)
    assert not outcome.failure
    assert outcome.messages_in > 0
    for name in LIVE_ONLY:
        with pytest.raises(ConfigurationError, match='live graph only'):
            node_class(name)


FILE = """
oak:
  wheel_kinematics: {ros__parameters: {wheel_radius: 0.21}}
/elm/wheel_kinematics: {ros__parameters: {wheel_radius: 0.22}}
/oak/**: {ros__parameters: {rate: 7.0, laps: 3}}
"""


def test_parameters_are_those_that_the_live_node_would_take(tmp_path):
    path = tmp_path / 'two.yaml'
    path.write_text(FILE)
    given = parameters(str(path), 'wheel_kinematics', '/oak')
    assert given['wheel_radius'] == 0.21
    assert 'laps' not in given
    assert parameters(str(path), 'wheel_kinematics', '/elm') == {'wheel_radius': 0.22}
    assert parameters(str(path), 'route_follower', '/oak')['laps'] == 3
    assert parameters(str(path), 'route_follower', '/') == {}
    with pytest.raises(ConfigurationError, match='it is for /elm or /oak; give it by --namespace'):
        parameters(str(path), 'wheel_kinematics')
    path.write_text(FILE + '"/**": {ros__parameters: {wheel_radius: 0.3}}\n')
    assert parameters(str(path), 'wheel_kinematics', '/oak')['wheel_radius'] == 0.3  # as rcl does


def test_what_the_robot_has_learnt_stays_untouched(tmp_path):
    path = tmp_path / 'one.yaml'
    path.write_text('/**: {ros__parameters: {memory_file: /m, state_file: /s}}\n')
    assert parameters(str(path), 'motion_generator')['memory_file'] == ''
    assert parameters(str(path), 'granier_probe')['state_file'] == ''


def copied(source, target, change):
    """Write a bag again, message by message as ``change`` of (topic, stamp, data) has it."""
    with BagReader(source) as bag, BagWriter(target) as writer:
        topics = {}
        for message in bag.messages():
            for topic, stamp, data, kind in change(message):
                if topic not in topics:
                    topics[topic] = writer.add_topic(topic, kind)
                writer.write(topics[topic], stamp, data)
    return target


def test_a_robot_with_a_namespace_is_the_same_robot(recorded, tmp_path):
    def named(message):
        topic = message.connection.topic
        yield f'/oak{topic}', message.stamp, message.data, message.connection.type

    copied(recorded / 'c', tmp_path / 'oak', named)
    joints = codec(JointState)
    only = PLAN._replace(nodes=('wheel_kinematics',))
    there = only._replace(namespace='/oak', remap=())
    assert not reprocess(recorded / 'c', tmp_path / 'one', only).failure
    assert not reprocess(tmp_path / 'oak', tmp_path / 'two', there).failure
    with BagReader(tmp_path / 'one') as one, BagReader(tmp_path / 'two') as two:
        assert set(two.topics) == {f'/oak{topic}' for topic in one.topics}
        assert one.counts['/turrets/command'] > 0
        for a, b in zip(
            one.messages(['/turrets/command']), two.messages(['/oak/turrets/command']), strict=True
        ):
            ours, theirs = (joints.decode(message.data) for message in (a, b))
            assert (a.stamp, ours.position, ours.velocity) == (
                b.stamp, theirs.position, theirs.velocity
            )  # fmt: skip


def test_the_time_is_that_of_the_clock_in_the_bag(recorded, tmp_path):
    """Beside a simulation ten times as fast as the clock on the wall."""
    clocks = codec(Clock)

    def hurried(message):
        wall = NOON + (message.stamp - NOON) // 10
        tick = clocks.encode(Clock(clock=stamp_of(message.stamp)))
        if message.connection.topic != '/clock':
            yield '/clock', wall, tick, 'rosgraph_msgs/msg/Clock'
            yield message.connection.topic, wall, message.data, message.connection.type

    copied(recorded / 'c', tmp_path / 'hurried', hurried)
    only = PLAN._replace(nodes=('wheel_kinematics',))
    assert not reprocess(recorded / 'c', tmp_path / 'one', only).simulated
    outcome = reprocess(tmp_path / 'hurried', tmp_path / 'two', only)
    assert not outcome.failure
    assert outcome.simulated
    with BagReader(tmp_path / 'one') as one, BagReader(tmp_path / 'two') as two:
        assert one.counts['/odom'] > 100
        for topic in diff(one, two, ['/odom', '/turrets/command'], Tolerance()):
            assert topic.same, topic
        assert abs(one.end - two.end) < SECOND


OMNI = (
    ('omni_kinematics', OmniKinematics),
    ('localization', Localization),
    ('omni_simulator', OmniSimulator),
)


def test_poses_are_those_of_the_live_run_where_odometry_and_gyro_have_one_stamp(tmp_path):
    """Odometry is derived in the run, the gyro is in the bag: who comes first is as it was."""
    twists = codec(TwistStamped)
    with BagWriter(tmp_path / 'live') as writer:
        transcript = Transcript(writer)
        graph = InProcessGraph(transcript.record, NOON)
        for name, kind in OMNI:
            InProcessNode(graph, kind, parameters('omni.yaml', name))
        graph.start()
        topic = writer.add_topic('/cmd_vel', 'geometry_msgs/msg/TwistStamped')
        for i in range(1, 200):
            twist = TwistStamped()
            twist.header.stamp = stamp_of(NOON + i * SECOND // 10)
            twist.header.frame_id = 'base_link'
            twist.twist.linear.x, twist.twist.angular.z = 0.3, 0.5
            data = twists.encode(twist)
            graph.feed('/cmd_vel', NOON + i * SECOND // 10, data)
            writer.write(topic, NOON + i * SECOND // 10, data)
        graph.stop()
        transcript.flush()
    plan = Plan('omni.yaml', ('omni_kinematics', 'localization'), (), 'zstd')
    assert not reprocess(tmp_path / 'live', tmp_path / 'again', plan).failure
    with BagReader(tmp_path / 'live') as live, BagReader(tmp_path / 'again') as again:
        assert live.counts['/pose'] > 100
        for found in diff(live, again, ['/odom', '/pose'], Tolerance()):
            assert found.same, found


def test_a_clock_that_goes_back_is_told(tmp_path):
    clocks = codec(Clock)
    with BagWriter(tmp_path / 'in') as writer:
        topic = writer.add_topic('/clock', 'rosgraph_msgs/msg/Clock')
        for i, second in enumerate((5, 6, 2)):
            writer.write(topic, i, clocks.encode(Clock(clock=stamp_of(second * SECOND))))
    outcome = reprocess(tmp_path / 'in', tmp_path / 'out', PLAN)
    assert '/clock goes back from 6000000000 to 2000000000 ns' in outcome.failure
    assert not (tmp_path / 'out').exists()


def test_no_node_is_an_error(alone, recorded, tmp_path):
    status, _, errors = alone('reprocess', recorded / 'c', tmp_path / 'out', '-n', ' ,')
    assert status == 1
    assert 'give at least one node' in errors
    assert not (tmp_path / 'out').exists()


def test_errors_and_warnings_are_told(alone, recorded, tmp_path):
    status, _, errors = alone('reprocess', tmp_path / 'nowhere', tmp_path / 'out')
    assert status == 1
    assert 'nowhere' in errors
    status, out, _ = alone('reprocess', recorded / 'c', tmp_path / 'out')
    assert status == 0
    assert '/pose is not in the bag' in out


def test_diff_tells_by_its_status(alone, recorded, tmp_path):
    reprocess(recorded / 'a', tmp_path / 'out', PLAN)
    status, out, _ = alone('bag', 'diff', recorded / 'a', recorded / 'c', '--common')
    assert status == 1
    assert 'DIFFERENT' in out
    status, out, _ = alone(
        'bag', 'diff', recorded / 'a', tmp_path / 'out', '--topics', '/odom', '-t', '1e-9'
    )
    assert status == 0
