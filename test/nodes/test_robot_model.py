"""Every robot is seen out of the box: its description, joints that roll, one tree of transforms."""

from __future__ import annotations

from bisect import bisect_left
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip('rclpy')

from rosbags.highlevel import AnyReader
from sensor_msgs.msg import JointState

from agv_motion.bag.recording.recorded_transforms import RecordedTransforms
from agv_motion.bag.writer import BagWriter
from agv_motion.model.urdf_reading import read_urdf
from agv_motion.nodes.robot_model import RobotModelNode
from agv_motion.nodes.simulator import Simulator
from agv_motion.reprocess.recorded import parameters
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.messages import type_name

SECOND = 1_000_000_000
SCENES = {
    'tree': (['/'], 3.0, ['wheel_0', 'wheel_1', 'wheel_2', 'probe_3']),
    'omni': (['/'], 12.0, ['wheel_0', 'wheel_1', 'wheel_2', 'imu_link']),
    'differential': (['/hare'], 3.0, ['hare/left_wheel', 'hare/right_wheel', 'hare/caster']),
    'trees': (['/oak', '/ash'], 2.0, [f'{n}/wheel_{i}' for n in ('oak', 'ash') for i in range(3)]),
}  # fmt: skip


READ = '/tf', '/tf_static', '/pose', '/fix', '/joint_states', '/robot_description'


class Told:
    """What was recorded, by rosbags' reader; read once, since opening a bag takes it seconds."""

    def __init__(self, path):
        with AnyReader([path]) as reader:
            wanted = [c for c in reader.connections if c.topic.endswith(READ)]
            self._messages = [(connection.topic, reader.deserialize(data, connection.msgtype))
                              for connection, _, data in reader.messages(wanted)]  # fmt: skip

    def read(self, *ends):
        """Return topic and message of topics with these ends."""
        found = [row for row in self._messages if row[0].endswith(ends)]
        assert found, f'none of {ends}'
        return found


def stamp_of(message):
    return message.header.stamp.sec * SECOND + message.header.stamp.nanosec


class Tree:
    """An independent tree of transforms: each frame with its parent, and where it was when."""

    def __init__(self, told):
        self.parents, self.when, self.fixed = {}, {}, set()
        for topic, message in told.read('/tf', '/tf_static'):
            for one in message.transforms:
                child = one.child_frame_id
                assert self.parents.setdefault(child, one.header.frame_id) == one.header.frame_id
                p, q = one.transform.translation, one.transform.rotation
                self.when.setdefault(child, {})[stamp_of(one)] = (
                    np.array([p.x, p.y, p.z]), np.array([q.x, q.y, q.z, q.w])
                )  # fmt: skip
                self.fixed |= {child} if topic == '/tf_static' else set()
        self.stamps = {child: sorted(found) for child, found in self.when.items()}

    def chain(self, frame):
        """Return the frames from this one up to the root."""
        found = [frame]
        while found[-1] in self.parents:
            found.append(self.parents[found[-1]])
            assert len(found) == len(set(found)), 'a loop'
        return found

    def step(self, child, stamp):
        """Return where a frame is in its parent; between two instants, as tf2 has it."""
        stamps, when = self.stamps[child], self.when[child]
        if child in self.fixed:
            return when[stamps[0]]
        assert stamps[0] <= stamp <= stamps[-1], f'{child} at {stamp}: {stamps[0]} to {stamps[-1]}'
        after = bisect_left(stamps, stamp)
        if stamps[after] == stamp:
            return when[stamp]
        (p, q), (r, s) = when[stamps[after - 1]], when[stamps[after]]
        share = (stamp - stamps[after - 1]) / (stamps[after] - stamps[after - 1])
        turned = q + share * (s if q @ s > 0 else -s - q) if q @ s <= 0 else q + share * (s - q)
        return p + share * (r - p), turned / np.linalg.norm(turned)

    def place(self, frame, stamp):
        """Return where a frame is in the root."""
        place = np.zeros(3)
        for child in self.chain(frame)[:-1]:
            origin, (x, y, z, w) = self.step(child, stamp)
            u = np.array([x, y, z])
            place = origin + place + 2 * np.cross(u, np.cross(u, place) + w * place)
        return place


@pytest.fixture(scope='module', params=SCENES)
def scene(request, tmp_path_factory, live_in_process):
    """Return a bag of robots as a recorder leaves it, and the names of their last frames."""
    namespaces, seconds, ends = SCENES[request.param]
    path = tmp_path_factory.mktemp('scene') / 'bag'
    with BagWriter(path) as bag:
        handles = {}
        transforms = RecordedTransforms(lambda name, kind, qos: bag.add_topic(name, kind, qos=qos))

        def record(publisher, now, data):
            topic, kind = publisher.topic, type_name(publisher.kind)
            if topic not in handles:
                moves = transforms.wants(topic, kind)
                handles[topic] = bag.add_topic(topic, kind), moves
            handle, moves = handles[topic]
            bag.write(handle, now, data)
            for other, told in transforms.take(topic, data) if moves else ():
                bag.write(other, now, told)

        robot = request.param.removesuffix('s')
        for namespace in namespaces if robot != 'differential' else ():
            pose = f'{namespace}/pose'.replace('//', '/')
            assert transforms.wants(pose, 'geometry_msgs/msg/PoseWithCovarianceStamped')
        often = {'fixes.rate': 10.0} if robot == 'tree' else {}
        graph = live_in_process(robot, namespaces, record, seconds, simulator=often)
        for handle, told in transforms.last():
            bag.write(handle, graph.now, told)
    assert not [text for text in graph.complaints if 'joint' in text or 'frame' in text]
    told = Told(path)
    return SimpleNamespace(read=told.read, ends=ends, namespaces=namespaces, tree=Tree(told))


def test_the_tree_of_transforms_reaches_from_the_map_to_every_wheel_at_every_instant(scene):
    tree = scene.tree
    assert {tree.chain(frame)[-1] for frame in tree.parents} == {'map'}
    instants = sorted({s for stamps in tree.stamps.values() for s in stamps})
    assert len(instants) > 10
    for end in scene.ends:
        heights = [tree.place(end, stamp)[2] for stamp in instants[:: max(len(instants) // 40, 1)]]
        heights.append(tree.place(end, instants[-1])[2])
        assert max(heights) - min(heights) < 1e-9


def test_a_look_up_at_the_instant_of_a_pose_is_the_pose(scene):
    tree = scene.tree
    topic = '/fix' if scene.namespaces == ['/hare'] else '/pose'
    for name, message in scene.read(topic):
        prefix = name.removesuffix(topic)[1:]
        place = message.pose.pose.position
        found = tree.place(f'{prefix}/base_link'.lstrip('/'), stamp_of(message))
        assert found == pytest.approx((place.x, place.y, 0.0), abs=1e-6)


def test_wheels_roll_as_fast_as_they_say(scene):
    for namespace in scene.namespaces:
        topic = f'{namespace}/joint_states'.replace('//', '/')
        told = [m for t, m in scene.read('/joint_states') if t == topic]
        (description,) = [m for t, m in scene.read('/robot_description')
                          if t.startswith(namespace)]  # fmt: skip
        model = read_urdf(description.data)
        assert set(told[0].name) == set(model.moving)
        for i, name in enumerate(told[0].name):
            if name.endswith('_steering'):
                continue
            positions = np.array([m.position[i] for m in told])
            times = np.array([stamp_of(m) for m in told]) * 1e-9
            rates = np.array([m.velocity[i] for m in told])
            rolled = np.sum(0.5 * (rates[1:] + rates[:-1]) * np.diff(times))
            travel = np.sum(np.abs(np.diff(positions)))
            assert travel > 0.0 or 'turret' in name  # whose turrets turn before its wheels roll
            assert positions[-1] - positions[0] == pytest.approx(rolled, abs=0.1 * travel + 0.01)


def alone(**given):
    """Return a node by itself, what feeds it, and what it said of its joints."""
    said = []

    def record(publisher, _, data):
        if publisher.topic.endswith('joint_states'):
            said.append(codec(JointState).decode(data))

    graph = InProcessGraph(record, 10 * SECOND)
    InProcessNode(graph, RobotModelNode, given, {}, '/')
    graph.start()

    def feed(seconds, names, positions, velocities, topic='/turrets/state'):
        message = JointState(name=names, position=positions, velocity=velocities)
        message.header.stamp.sec = int(seconds)
        message.header.stamp.nanosec = round((seconds % 1) * SECOND)
        graph.feed(topic, round(seconds * SECOND), codec(JointState).encode(message))

    return SimpleNamespace(said=said, feed=feed, graph=graph)


TURRETS = [f'turret_{i}_{part}' for part in ('steering', 'wheel') for i in range(3)]


def test_drives_that_count_no_turns_get_wheels_that_roll_all_the_same():
    robot = alone()
    for i in range(11):
        robot.feed(11.0 + 0.1 * i, TURRETS, [0.3] * 3 + [0.0] * 3, [0.0] * 3 + [1.0, -2.0, 0.0])
    last = robot.said[-1]
    found = dict(zip(last.name, last.position, strict=True))
    assert [found[name] for name in TURRETS] == pytest.approx([0.3] * 3 + [1.0, -2.0, 0.0])
    assert last.header.frame_id == 'base_link'


def test_the_wheels_of_the_simulated_tree_roll_in_both_directions():
    robot = alone()
    simulated = parameters('tree.yaml', 'simulator')
    InProcessNode(robot.graph, Simulator, simulated | {'command_timeout': 60.0}, {}, '/').activate()
    for i in range(30):
        robot.feed(11.0 + 0.1 * i, TURRETS, [0.0] * 6, [0.0] * 3 + [1.0, -2.0, 0.0],
                   '/turrets/command')  # fmt: skip
    first, last = robot.said[len(robot.said) // 2], robot.said[-1]
    passed = (stamp_of(last) - stamp_of(first)) / SECOND
    before, after = (dict(zip(one.name, one.position, strict=True)) for one in (first, last))
    moved = [after[name] - before[name] for name in TURRETS[3:]]
    assert moved == pytest.approx([passed, -2.0 * passed, 0.0], rel=0.02)


def test_what_is_not_finite_or_does_not_fit_is_not_told():
    robot, nan = alone(), float('nan')
    robot.feed(11.0, TURRETS, [0.1, nan, 0.3, 1.0, 1.0, nan], [nan] * 6)
    assert np.isfinite(robot.said[-1].position).all()
    assert 'turret_1_steering' not in robot.said[-1].name
    assert np.isfinite(robot.said[-1].velocity).all()
    before = len(robot.said)
    robot.feed(12.0, TURRETS, [0.1, 0.2], [])
    assert len(robot.said) == before
    assert any('2 positions for 6 joints' in text for text in robot.graph.complaints)


def test_joints_are_told_no_faster_than_asked_for():
    robot = alone(rate=2.0)
    for i in range(21):
        robot.feed(11.0 + 0.1 * i, TURRETS, [0.0] * 6, [1.0] * 6)
    assert len(robot.said) == 5
    assert robot.said[-1].position[-1] == pytest.approx(2.0)


def test_a_robot_of_other_wheels_has_the_names_that_its_drives_have():
    robot = alone(platform='differential', joint_names=['l', 'r'], wheel_radii=[0.1, 0.1])
    robot.feed(11.0, ['r', 'l'], [2.0, 1.0], [], '/wheels/state')
    assert dict(zip(robot.said[-1].name, robot.said[-1].position, strict=True)) == {'l': 1, 'r': 2}
