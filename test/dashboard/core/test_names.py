"""Whose a topic is: a namespace is a robot."""

from __future__ import annotations

import pytest

from agv_motion.dashboard.core.names import (
    FIELDS,
    SHARED,
    TOPICS,
    namespace_of,
    robot_of,
    split,
    type_of,
)


@pytest.mark.parametrize(
    ('namespace', 'robot'),
    [('/', 'robot'), ('/oak', 'oak'), ('/yard/oak', 'yard.oak'), ('/robot', '.robot')],
)
def test_a_robot_has_the_name_of_its_namespace_and_back(namespace, robot):
    assert robot_of(namespace) == robot
    assert namespace_of(robot) == namespace.rstrip('/')


@pytest.mark.parametrize('namespace', ['/1oak', '/a b', '/a/b/c/d/e', 'oak', '/' + 65 * 'a'])
def test_a_namespace_that_ros_does_not_allow_is_no_robot(namespace):
    assert robot_of(namespace) == ''
    assert split(f'{namespace}/odom') is None


@pytest.mark.parametrize(
    ('topic', 'found'),
    [('/oak/turrets/state', ('oak', 'turrets/state')), ('/state', ('robot', 'state')),
     ('/oak/ghost/state', ('oak', 'ghost/state')), ('/clock', ('', 'clock')),
     ('/oak/clock', None), ('/oak/nothing', None)],
)  # fmt: skip
def test_a_topic_is_parted_at_the_longest_name_that_is_known(topic, found):
    assert split(topic) == found


def test_every_type_that_is_known_has_its_fields():
    assert {type_of(name) for name in (*TOPICS, *SHARED)} == FIELDS.keys()
    assert type_of('nothing') == ''
