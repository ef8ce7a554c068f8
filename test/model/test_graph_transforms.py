"""What robots say becomes /tf and /tf_static, whoever hears it."""

from __future__ import annotations

from math import cos, pi, sin
from struct import pack

import pytest

from agv_motion.model.graph_transforms import SOURCES, GraphTransforms

URDF = """<robot name="r"><link name="base_link"/><link name="turret_0"/><link name="wheel_0"/>
<link name="mast"/>
<joint name="turret_0_steering" type="continuous"><parent link="base_link"/><child link="turret_0"/>
<origin xyz="1 0.5 0.1"/><axis xyz="0 0 1"/></joint>
<joint name="turret_0_wheel" type="continuous"><parent link="turret_0"/><child link="wheel_0"/>
<axis xyz="0 1 0"/></joint>
<joint name="mast_joint" type="fixed"><parent link="base_link"/><child link="mast"/>
<origin xyz="0 0 2"/></joint></robot>"""


def told(say, several):
    return {topic: say.transforms(data) for topic, data in several}


def test_a_robot_in_a_namespace_from_map_to_wheel(say):
    graph = GraphTransforms()
    assert graph.take('/oak/robot_description', say.text(URDF)) == []
    found = told(
        say, graph.take('/oak/odom', say.odometry(1.0, (1, 0, 0), 'oak/odom', 'oak/base_link'))
    )
    assert [t[:3] for t in found['/tf']] == [('oak/odom', 'oak/base_link', 1.0)]
    assert [t[:2] for t in found['/tf_static']] == [('oak/base_link', 'oak/mast')]
    assert found['/tf_static'][0][3] == (0.0, 0.0, 2.0)
    found = told(say, graph.take('/oak/pose', say.pose(1.0, (5.0, 7.0, pi / 2))))
    ((parent, child, stamp, place, turned),) = found['/tf']
    assert (parent, child, stamp) == ('map', 'oak/odom', 1.0)
    assert place == pytest.approx((5.0, 6.0, 0.0))  # one metre along y behind the robot
    assert turned == pytest.approx((0.0, 0.0, sin(pi / 4), cos(pi / 4)))
    angles = {'turret_0_steering': pi / 2, 'turret_0_wheel': 0.5, 'unknown': 1.0}
    found = told(say, graph.take('/oak/joint_states', say.joints(1.0, angles, 'oak/base_link')))
    turret, wheel = found['/tf']
    assert turret[:2] == ('oak/base_link', 'oak/turret_0')
    assert turret[3] == pytest.approx((1.0, 0.5, 0.1))
    assert turret[4] == pytest.approx((0.0, 0.0, sin(pi / 4), cos(pi / 4)))
    assert wheel[:2] == ('oak/turret_0', 'oak/wheel_0')
    assert wheel[4] == pytest.approx((0.0, sin(0.25), 0.0, cos(0.25)))


def test_robots_side_by_side_keep_their_frames_apart_and_share_one_static_message(say):
    graph = GraphTransforms()
    frames = set()
    for name in ('oak', 'ash', 'elm'):
        graph.take(f'/{name}/robot_description', say.text(URDF))
        odom = say.odometry(1.0, (0, 0, 0), f'{name}/odom', f'{name}/base_link')
        found = told(say, graph.take(f'/{name}/odom', odom))
        frames |= {t[1] for several in found.values() for t in several}
    assert len(found['/tf_static']) == 3
    assert frames == {f'{n}/{f}' for n in ('oak', 'ash', 'elm') for f in ('base_link', 'mast')}


def test_a_robot_without_a_namespace_has_no_prefix_and_one_told_otherwise_has_its_own(say):
    graph = GraphTransforms()
    graph.take('/robot_description', say.text(URDF))
    found = told(say, graph.take('/joint_states', say.joints(1.0, {'turret_0_steering': 0.0})))
    assert {t[1] for several in found.values() for t in several} == {'turret_0', 'mast'}
    graph.take('/oak/robot_description', say.text(URDF))
    found = told(say, graph.take('/oak/odom', say.odometry(1.0, (0, 0, 0), 'o', 'pine_base_link')))
    assert found['/tf_static'][1][:2] == ('pine_base_link', 'pine_mast')


def test_a_fix_with_a_heading_stands_in_where_no_pose_is_told(say):
    graph = GraphTransforms()
    graph.take('/odom', say.odometry(1.0, (0, 0, 0)))
    assert graph.take('/fix', say.pose(1.0, (1, 2, 0), variance=0.0)) == []  # heading unknown
    assert graph.take('/fix', say.pose(1.0, (1, 2, 0), variance=3.2)) == []
    (first,) = graph.take('/fix', say.pose(1.0, (1, 2, 0)))
    assert say.transforms(first[1])[0][3] == pytest.approx((1, 2, 0))
    graph.take('/odom', say.odometry(2.0, (0, 0, 0)))
    graph.take('/pose', say.pose(2.0, (3, 4, 0)))
    assert graph.take('/fix', say.pose(2.0, (1, 2, 0))) == []


@pytest.mark.parametrize(('publisher', 'count'), [('/odom', 1), ('/fix', 1), ('/pose', 0)])
def test_where_a_pose_has_a_publisher_no_fix_stands_in(say, publisher, count):
    graph = GraphTransforms()
    graph.expect(publisher)
    graph.take('/odom', say.odometry(1.0, (0, 0, 0)))
    assert len(graph.take('/fix', say.pose(1.0, (1, 2, 0)))) == count


@pytest.mark.parametrize('topic', ['/robot_description', '/odom', '/pose', '/joint_states'])
def test_what_is_no_message_is_passed_over_with_its_reason(say, topic):
    graph = GraphTransforms()
    whole = {
        '/robot_description': say.text(URDF), '/odom': say.odometry(1.0, (0, 0, 0)),
        '/pose': say.pose(1.0, (0, 0, 0)), '/joint_states': say.joints(1.0, {'a': 0.0}),
    }[topic]  # fmt: skip
    for length in range(min(len(whole), 80)):
        assert graph.take(topic, whole[:length]) == []
        assert topic in graph.refused


def test_a_stamp_that_no_message_can_tell_is_passed_over_with_its_reason(say):
    graph = GraphTransforms()
    data = bytearray(say.odometry(1.0, (0, 0, 0)))
    data[4:12] = pack('<iI', 2**31 - 1, 2**32 - 1)
    assert graph.take('/odom', bytes(data)) == []
    assert 'behind the last one' in graph.refused


@pytest.mark.parametrize('where', [(float('nan'), 0, 0), (0, float('inf'), 0), (1e9, 0, 0)])
def test_a_place_that_is_none_goes_nowhere(say, where):
    graph = GraphTransforms()
    assert graph.take('/odom', say.odometry(1.0, where)) == []
    assert graph.take('/odom', say.odometry(1.0, (0, 0, 0))) != []
    assert graph.take('/pose', say.pose(1.0, where)) == []
    assert graph.take('/joint_states', say.joints(1.0, {'turret_0_wheel': where[1]})) == []


def test_only_topics_of_the_right_type_are_wanted():
    for name, kind in SOURCES.items():
        assert GraphTransforms.wants(f'/oak/{name}', kind)
        assert not GraphTransforms.wants(f'/oak/{name}', 'std_msgs/msg/Bool')
    assert not GraphTransforms.wants('/oak/odom/filtered', SOURCES['odom'])


def test_the_end_of_a_recording_reaches_as_far_as_odometry(say):
    graph = GraphTransforms()
    graph.take('/odom', say.odometry(1.0, (0, 0, 0)))
    graph.take('/pose', say.pose(1.0, (5, 0, 0)))
    graph.take('/odom', say.odometry(9.0, (1, 0, 0)))
    ((topic, data),) = graph.last()
    assert topic == '/tf'
    assert say.transforms(data) == [('map', 'odom', 9.0, (5, 0, 0), (0, 0, 0, 1))]
