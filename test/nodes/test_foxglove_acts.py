"""What clients of `/foxglove` send is a message of its type, whole and finite, or it is refused."""

from __future__ import annotations

from math import inf, nan
from types import SimpleNamespace as Some

import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseWithCovarianceStamped, Twist, TwistStamped
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger

from agv_motion.dashboard.server.fleet import RefusedError
from agv_motion.errors import AgvMotionError, SignalError
from agv_motion.nodes import foxglove_acts
from agv_motion.nodes.foxglove_acts import FoxgloveActs, decoded
from agv_motion.ros.cdr import codec

KINDS = Twist, TwistStamped, PoseWithCovarianceStamped, String, SetBool.Request, Trigger.Request


@pytest.mark.parametrize('kind', KINDS)
@pytest.mark.parametrize('padding', range(4))
def test_a_whole_message_is_taken(kind, padding):
    data = codec(kind).encode(kind())
    assert decoded('x', kind, data + bytes(padding)) == kind()


def test_a_message_of_another_type_is_refused_though_its_bytes_could_be_read():
    """A stamped twist read as one without a stamp would be another motion."""
    data = codec(TwistStamped).encode(TwistStamped())
    with pytest.raises(SignalError, match=r'where Twist has 52: is it another type'):
        decoded('/oak/cmd_vel/manual', Twist, data)


@pytest.mark.parametrize('number', [nan, inf, -inf])
def test_numbers_that_are_none_are_refused(number):
    message = TwistStamped()
    message.twist.linear.x = number
    with pytest.raises(SignalError, match=r'twist\.linear\.x = .*finite'):
        decoded('x', TwistStamped, codec(TwistStamped).encode(message))


@given(st.sampled_from(KINDS), st.binary(max_size=200), st.integers(0, 400), st.booleans())
def test_whatever_comes_is_a_message_or_refused(kind, noise, cut, head):
    whole = codec(kind).encode(kind())
    data = (whole[:cut] if head else b'') + noise
    try:
        found = decoded('x', kind, data)
    except AgvMotionError:
        return
    assert isinstance(found, kind)


def test_topics_that_are_opened_have_an_end(monkeypatch):
    monkeypatch.setattr(foxglove_acts, 'MOST_OPENED', 2)
    monkeypatch.setattr(foxglove_acts, 'RobotServices', lambda _: None)
    opened = []
    acts = FoxgloveActs(Some(node=None), lambda kind, topic: opened.append(topic))
    for topic in ('/a/mark', '/b/mark', '/a/mark'):
        acts.prepare(topic, 'std_msgs/msg/String')
    with pytest.raises(RefusedError, match='2 topics were opened here before'):
        acts.prepare('/c/mark', 'std_msgs/msg/String')
    acts.prepare('/b/mark', 'std_msgs/msg/String')
    assert opened == ['/a/mark', '/b/mark', '/a/mark', '/b/mark']
