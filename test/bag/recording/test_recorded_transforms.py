"""Every file of a bag has the transforms, those that hold for good included."""

from __future__ import annotations

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
    import numpy as np

    header = STORE.types['std_msgs/msg/Header'](time, 'base_link')
    names, nothing = [f'turret_{i}_steering' for i in range(3)], np.array([])
    message = kind(header, names, np.zeros(3), nothing, nothing)
    return bytes(STORE.serialize_cdr(message, 'sensor_msgs/msg/JointState'))


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
