"""One bag through the nodes: what was decided is decided again, the same bytes every time."""

from __future__ import annotations

import shutil
from math import nan

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import TwistStamped
from sensor_msgs.msg import JointState

from agv_motion.bag.editing.diff import Tolerance, diff
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import ConfigurationError
from agv_motion.nodes.catalogue import available
from agv_motion.nodes.localization import Localization
from agv_motion.nodes.omni_kinematics import OmniKinematics
from agv_motion.nodes.omni_simulator import OmniSimulator
from agv_motion.reprocess import Plan, reprocess
from agv_motion.reprocess.recorded import LIVE_ONLY, node_class, parameters
from agv_motion.reprocess.transcript import Transcript
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


def content(folder):
    """Return the bytes of all files of a folder."""
    return {path.relative_to(folder): path.read_bytes() for path in sorted(folder.rglob('*.mcap'))}


@pytest.fixture(scope='module')
def made(recorded, tmp_path_factory):
    """Return the folder of what the plan makes of a recording."""
    folder = tmp_path_factory.mktemp('made') / 'out'
    assert not reprocess(recorded / 'a', folder, PLAN).failure
    return folder


def test_what_was_decided_is_decided_again(recorded, made):
    with BagReader(recorded / 'a') as before, BagReader(made) as after:
        after.require(['/cmd_vel', '/turrets/command', '/odom', '/granier/sap_flow'])
        water = '/granier/water_use_today'
        made = sorted(after.topics.keys() - {'/tf', water})  # no /tf is in the simulation's bag
        for topic in diff(before, after, made, Tolerance()):
            assert topic.same, topic
        # of the quarter of an hour before it began a recording lacks the last reading
        (drunk,) = diff(before, after, [water], Tolerance(relative=1e-3))
        assert drunk.same, drunk
        assert any(
            m.data != next(after.messages(['/cmd_vel'])).data for m in after.messages(['/cmd_vel'])
        )


def one_by_one(monkeypatch, *, rows=True):
    """Let nothing be known before it comes, and where asked let no row go as it is."""
    monkeypatch.setattr(InProcessListener, 'look_ahead', lambda *_: None)
    if rows:
        monkeypatch.setattr(InProcessRowPublisher, 'goes_as_it_is', lambda _: False)


@pytest.mark.parametrize('rows', [False, True])
def test_rows_many_together_lead_to_the_same_bytes(recorded, made, tmp_path, monkeypatch, rows):
    one_by_one(monkeypatch, rows=rows)
    reprocess(recorded / 'a', tmp_path / 'apart' / 'out', PLAN)
    assert content(made.parent) == content(tmp_path / 'apart')


def test_states_that_cannot_be_taken_together_are_taken_one_by_one(recorded, tmp_path, monkeypatch):
    joints = codec(JointState)
    with BagReader(recorded / 'a') as bag, BagWriter(tmp_path / 'odd') as writer:
        topics = {name: writer.add_topic(name, c.type) for name, c in bag.topics.items()}
        states = 0
        for message in bag.messages():
            data = message.data
            if message.connection.topic == '/turrets/state':
                states += 1
                state = joints.decode(data)
                if 100 < states < 110:
                    state.position[1] = nan
                elif states > 150:
                    state.name.reverse()
                    state.position.reverse()
                    state.velocity.reverse()
                data = joints.encode(state)
            writer.write(topics[message.connection.topic], message.stamp, data)
    assert states > 150
    together = reprocess(tmp_path / 'odd', tmp_path / 'together' / 'out', PLAN)
    one_by_one(monkeypatch)
    apart = reprocess(tmp_path / 'odd', tmp_path / 'apart' / 'out', PLAN)
    assert content(tmp_path / 'together') == content(tmp_path / 'apart')
    assert together.complaints == apart.complaints
    assert any('must be finite' in text for text in together.complaints)


def test_another_configuration_decides_otherwise(recorded, made, tmp_path):
    tuned = tmp_path / 'tuned.yaml'
    tuned.write_text('/**/wheel_kinematics:\n  ros__parameters: {wheel_radius: 0.2}\n')
    only = PLAN._replace(config=str(tuned), nodes=('wheel_kinematics',))
    outcome = reprocess(recorded / 'a', tmp_path / 'two', only)
    assert not outcome.failure
    with BagReader(made) as one, BagReader(tmp_path / 'two') as two:
        assert '/cmd_vel' not in two.topics
        (commands,) = diff(one, two, ['/turrets/command'], Tolerance(1e-9))
    worst = commands.worst['velocity[4]']
    assert 0.0 < worst.second < 0.8 * worst.first  # a larger wheel turns more slowly


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


def test_a_robot_with_a_namespace_is_the_same_robot(recorded, copied, tmp_path):
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
        assert set(two.topics) == {f'/oak{topic}' if topic != '/tf' else topic
                                   for topic in one.topics}  # fmt: skip
        assert one.counts['/turrets/command'] > 0
        for a, b in zip(
            one.messages(['/turrets/command']), two.messages(['/oak/turrets/command']), strict=True
        ):
            ours, theirs = (joints.decode(message.data) for message in (a, b))
            assert (a.stamp, ours.position, ours.velocity) == (
                b.stamp, theirs.position, theirs.velocity
            )  # fmt: skip


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


def test_transforms_follow_from_what_is_made_anew(recorded, tmp_path):
    """From all that is reprocessed; a parent and a child of each, and none twice."""
    plan = PLAN._replace(nodes=(*PLAN.nodes, 'localization', 'robot_model'), remap=())
    outcome = reprocess(recorded / 'a', tmp_path / 'out', plan)
    assert not outcome.failure
    with BagReader(tmp_path / 'out') as after:
        assert outcome.messages_out == after.message_count
        assert after.topics['/tf'].type == 'tf2_msgs/msg/TFMessage'
        turrets = {('base_link', f'turret_{i}') for i in range(3)}
        wheels = {(f'turret_{i}', f'wheel_{i}') for i in range(3)}
        whole = {('map', 'odom'), ('odom', 'base_link')} | turrets | wheels
        told = pairs(after, '/tf') | pairs(after, '/tf_static')
        assert whole <= told
        assert len({child for _, child in told}) == len(told)  # each has one parent
        stamps = [m.stamp for m in after.messages(['/tf', '/odom'])]
        assert stamps == sorted(stamps)
        odom = [m.stamp for m in after.messages(['/odom'])]
        assert {m.stamp for m in after.messages(['/tf'])} >= set(odom)


def pairs(bag, topic):
    """Return parent and child of each transform of a topic, by another library."""
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_JAZZY)
    return {
        (one.header.frame_id, one.child_frame_id)
        for m in bag.messages([topic])
        for one in store.deserialize_cdr(m.data, m.connection.type).transforms
    }


def test_transforms_follow_from_joints_and_model_that_were_recorded(recorded, tmp_path):
    """A recording of a robot model, beside which only its odometry is made anew."""
    with BagReader(recorded / 'c') as bag:
        kinds = set(bag.topics)
    model = PLAN._replace(nodes=('robot_model',), remap=())
    assert not reprocess(recorded / 'c', tmp_path / 'model', model).failure
    with BagReader(tmp_path / 'model') as told, BagReader(recorded / 'c') as bag:
        assert '/tf' not in told.topics  # nobody told where the robot is
        with BagWriter(tmp_path / 'both') as writer:
            topics = {}
            for m in sorted([*bag.messages(), *told.messages()], key=lambda m: m.stamp):
                topic = m.connection.topic
                if topic not in topics:
                    topics[topic] = writer.add_topic(topic, m.connection.type)
                writer.write(topics[topic], m.stamp, m.data)
    only = PLAN._replace(nodes=('wheel_kinematics',), remap=())
    outcome = reprocess(tmp_path / 'both', tmp_path / 'out', only)
    assert not outcome.failure
    with BagReader(tmp_path / 'out') as after:
        assert '/joint_states' not in after.topics
        found = pairs(after, '/tf')
        assert {('odom', 'base_link'), ('turret_2', 'wheel_2')} <= found
        assert (('map', 'odom') in found) == bool(kinds & {'/pose', '/fix'})
