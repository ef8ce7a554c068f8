"""What a robot in a bag covered of the floor, as its description and its joints tell."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
import shapely

pytest.importorskip('rclpy')

from sensor_msgs.msg import JointState
from std_msgs.msg import String

from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.kinematics.platform import PlatformParameters
from agv_motion.model.robots import tree_model
from agv_motion.model.urdf import write_urdf
from agv_motion.report.recorded_footprint import moments, read_footprints
from agv_motion.ros.cdr import codec

URDF = write_urdf(tree_model(PlatformParameters(), 'base_link'))
NAMES = [f'turret_{i}_steering' for i in range(3)]


def read(path, description, topic='/oak/robot_description', states='/oak/turrets/state'):
    """Return the footprints of the oak after 0 and 10 s, between which its turrets turn by 90."""
    with BagWriter(path) as bag:
        told = bag.add_topic(topic, 'std_msgs/msg/String')
        bag.write(told, 0, codec(String).encode(String(data=description)))
        joints = bag.add_topic(states, 'sensor_msgs/msg/JointState')
        for second, angle in ((0, 0.0), (10, pi / 2)):
            message = JointState(name=NAMES, position=[angle] * 3)
            message.header.stamp.sec = second
            bag.write(joints, second * 10**9, codec(JointState).encode(message))
    with BagReader(path) as bag:
        return read_footprints(bag, '/oak/odom/filtered', [0.4, 9.0])


def lengths(shape):
    west, south, east, north = shapely.Polygon(shape.wheels[0]).bounds
    return east - west, north - south


def test_wheels_stand_as_they_stood_then(tmp_path):
    before, after = read(tmp_path / 'bag', URDF)
    assert lengths(before) == pytest.approx((0.2, 0.066))
    assert lengths(after) == pytest.approx((0.066, 0.2))
    assert before.reach == pytest.approx(1.18 + 0.12, abs=0.01)  # of the turrets on its rim


def test_wheels_of_which_nobody_tells_are_left_out(tmp_path):
    found = read(tmp_path / 'bag', URDF, states='/ash/turrets/state')
    assert [shape.wheels for shape in found] == [(), ()]


@pytest.mark.parametrize(
    ('description', 'topic'),
    [
        ('', '/oak/robot_description'), ('<nonsense', '/oak/robot_description'),
        ('<robot name="r"><link name="a"/></robot>', '/oak/robot_description'),
        (URDF, '/ash/robot_description'),
    ],
)  # fmt: skip
def test_a_bag_that_does_not_tell_the_size_is_taken_at_its_word(tmp_path, description, topic):
    assert read(tmp_path / 'bag', description, topic) is None


def test_a_description_without_a_namespace_is_everybodys(tmp_path):
    assert read(tmp_path / 'bag', URDF, '/robot_description') is not None


@pytest.mark.parametrize('rows', [0, 1, 2, 3, 5, 1000])
def test_a_way_is_drawn_from_its_first_to_its_last_row(rows):
    found = moments(rows)
    assert len(found) == min(rows, 5)
    assert found == sorted(set(np.clip(found, 0, rows - 1).tolist()))
    assert not rows or (found[0], found[-1]) == (0, rows - 1)
