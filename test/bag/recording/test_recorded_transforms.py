"""Every file of a bag has the transforms, those that hold for good included."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip('geometry_msgs')

from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

from agv_motion.bag.recording.recorded_transforms import RecordedTransforms
from agv_motion.bag.recording.recording import Recording
from agv_motion.bag.recording.storage_parameters import StorageParameters
from agv_motion.kinematics.platform import PlatformParameters
from agv_motion.model.robots import tree_model
from agv_motion.model.urdf import write_urdf

SECOND = 1_000_000_000
STORE = get_typestore(Stores.ROS2_JAZZY)


def description():
    kind = STORE.types['std_msgs/msg/String']
    message = kind(write_urdf(tree_model(PlatformParameters(), 'base_link')))
    return bytes(STORE.serialize_cdr(message, 'std_msgs/msg/String'))


def joints(seconds):
    time = STORE.types['builtin_interfaces/msg/Time'](seconds, 0)
    kind = STORE.types['sensor_msgs/msg/JointState']
    header = STORE.types['std_msgs/msg/Header'](time, 'base_link')
    names, nothing = [f'turret_{i}_steering' for i in range(3)], np.array([])
    message = kind(header, names, np.zeros(3), nothing, nothing)
    return bytes(STORE.serialize_cdr(message, 'sensor_msgs/msg/JointState'))


def located(message_type, child=(), twist=()):
    """Return a message of a robot that is sure of its place."""
    make = STORE.types
    header = make['std_msgs/msg/Header'](
        make['builtin_interfaces/msg/Time'](1, 0), 'odom' if child else 'map'
    )
    place = make['geometry_msgs/msg/Point'](1.0, 2.0, 0.0)
    turned = make['geometry_msgs/msg/Quaternion'](0.0, 0.0, 0.0, 1.0)
    known = make['geometry_msgs/msg/Pose'](place, turned)
    pose = make['geometry_msgs/msg/PoseWithCovariance'](known, np.full(36, 0.01))
    return bytes(
        STORE.serialize_cdr(make[message_type](header, *child, pose, *twist), message_type)
    )


@pytest.mark.parametrize(('recorded', 'count'), [('/oak/fix', 1), ('/oak/pose', 0)])
def test_a_fix_stands_in_where_no_pose_is_recorded(recorded, count):
    fix = 'geometry_msgs/msg/PoseWithCovarianceStamped'
    transforms = RecordedTransforms(lambda *_: 0)
    assert transforms.wants(recorded, fix)
    assert not transforms.wants('/oak/pose', 'geometry_msgs/msg/PoseStamped')  # of no use here
    still = STORE.types['geometry_msgs/msg/Vector3'](0.0, 0.0, 0.0)
    twist = STORE.types['geometry_msgs/msg/Twist'](still, still)
    twist = STORE.types['geometry_msgs/msg/TwistWithCovariance'](twist, np.zeros(36))
    transforms.take('/oak/odom', located('nav_msgs/msg/Odometry', ['base_link'], [twist]))
    assert len(transforms.take('/oak/fix', located(fix))) == count


def test_each_file_begins_with_what_holds_for_good(tmp_path):
    recording = Recording(tmp_path / 'bag', StorageParameters())
    transforms = RecordedTransforms(recording.add_topic)
    assert transforms.wants('/robot_description', 'std_msgs/msg/String')
    assert not transforms.wants('/state', 'std_msgs/msg/String')
    for topic, data in (('/robot_description', description()),
                        *(('/joint_states', joints(i)) for i in range(1, 4))):  # fmt: skip
        for handle, told in transforms.take(topic, data):
            recording.put(handle, SECOND, told, SECOND)
        recording.split()
    recording.close()
    files = sorted((tmp_path / 'bag').glob('*.mcap'))
    assert len(files) == 5
    for file in files[1:]:  # before, nobody has told the frame of the base
        if file == files[1]:
            continue
        with AnyReader([file]) as reader:
            children = {
                t.child_frame_id
                for c, _, data in reader.messages()
                if c.topic == '/tf_static'
                for t in reader.deserialize(data, c.msgtype).transforms
            }
        assert children == {'trunk', 'probe_1', 'probe_2', 'probe_3'}


def test_what_has_a_publisher_is_made_no_more(tmp_path):
    """The bag goes on with it under the handle that there is."""
    handles = {'/tf': 1, '/tf_static': 2}
    transforms = RecordedTransforms(lambda name, *_: handles[name])
    assert transforms.leave('/tf') is None
    transforms.take('/robot_description', description())
    assert [handle for handle, _ in transforms.take('/joint_states', joints(1))] == [2]
    assert transforms.leave('/tf_static') == 2
    assert transforms.take('/joint_states', joints(2)) == []
