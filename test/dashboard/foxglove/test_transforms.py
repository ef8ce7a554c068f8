"""Transforms where nobody says them: offered, made from what robots say, and only if chosen."""

from __future__ import annotations

import struct

import pytest

pytest.importorskip('geometry_msgs')  # whose definitions are told

from agv_motion.dashboard.foxglove.channels import GraphTopic
from agv_motion.dashboard.foxglove.transforms import DerivedTransforms

ODOM = GraphTopic('/oak/odom', 'nav_msgs/msg/Odometry', '')
TF = '/tf'


def text(words):
    data = words.encode() + b'\0'
    return struct.pack('<I', len(data)) + data


def odometry(second, x):
    """Return a nav_msgs/Odometry in CDR: frames odom and base_link, at (x, 0)."""
    body = struct.pack('<iI', second, 0) + text('oak/odom')
    body += bytes(-len(body) % 4) + text('oak/base_link')
    body += bytes(-len(body) % 8) + struct.pack('<7d', x, 0, 0, 0, 0, 0, 1) + bytes(36 * 8)
    return b'\0\1\0\0' + body + bytes(6 * 8 + 36 * 8)


def test_they_are_offered_only_where_nobody_says_them():
    derived = DerivedTransforms(3.0)
    assert set(derived.offered({'/oak/odom': ODOM})) == {'/tf', '/tf_static'}
    assert derived.needed({TF}) == {'/oak/odom'}
    assert derived.needed({'/oak/odom'}) == frozenset()
    real = GraphTopic(TF, 'tf2_msgs/msg/TFMessage', '')
    assert derived.offered({'/oak/odom': ODOM, TF: real}) == {}
    assert derived.needed({TF}) == frozenset()
    assert derived.offered({'/x': GraphTopic('/x', 'std_msgs/msg/String', '')}) == {}
    other = GraphTopic('/oak/odom', 'std_msgs/msg/String', '')
    assert derived.offered({'/oak/odom': other}) == {}


def test_they_follow_from_what_is_said_and_the_rest_passes_as_it_was_chosen():
    derived = DerivedTransforms(3.0)
    derived.offered({'/oak/odom': ODOM})
    said = [('/oak/odom', 7, odometry(5, 1.5)), ('/other', 8, b'x')]
    found = list(derived.passed(said, {TF, '/other'}))
    assert [(topic, stamp) for topic, stamp, _ in found] == [(TF, 7), ('/other', 8)]
    assert struct.pack('<d', 1.5) in found[0][2]
    assert b'oak/base_link' in found[0][2]
    assert list(derived.passed(said, {'/oak/odom'})) == said[:1]


def test_after_a_leap_back_they_begin_anew():
    derived = DerivedTransforms(3.0)
    derived.offered({'/oak/odom': ODOM})
    later, sooner = ('/oak/odom', 9, odometry(9, 1.0)), ('/oak/odom', 2, odometry(2, 0.5))
    assert len(list(derived.passed([later], {TF}))) == 1
    derived.forget()
    assert len(list(derived.passed([sooner], {TF}))) == 1
