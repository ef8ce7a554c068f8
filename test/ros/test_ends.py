"""What a node has opened: heard while it is there and active, and no longer."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from rclpy.qos import QoSProfile
from std_msgs.msg import String

from agv_motion.errors import SignalError
from agv_motion.ros.ends import Ends
from agv_motion.ros.qos import LATCHED


class Node:
    """A node of rclpy that keeps the callbacks that it is given."""

    def __init__(self):
        self.callbacks = []

    def create_timer(self, _seconds, callback, *, clock):
        self.callbacks.append(callback)

    def create_subscription(self, _kind, _topic, callback, _qos, *, event_callbacks):
        self.callbacks.append(callback)

    def destroy_timer(self, timer):
        pass

    destroy_subscription = destroy_timer


@pytest.fixture
def owner():
    told = []
    return SimpleNamespace(
        active=True, told=told, wake=lambda: None, message_of=str,
        refuse=lambda text: told.append(f'refused {text}'),
        stop_for=lambda where, error: told.append(f'stopped for {where}: {error}'),
    )  # fmt: skip


@pytest.fixture
def opened(owner):
    """Return the ends of a node, a timer, a topic, and what they have called."""
    node, called = Node(), []
    ends = Ends(node, owner)
    ends.every(1.0, lambda: called.append('timer'), None)
    ends.listen(String, 'word', called.append, QoSProfile(depth=1))
    return ends, *node.callbacks, called


def test_callbacks_run_while_the_node_is_active(owner, opened):
    _, tick, hear, called = opened
    tick()
    hear('a word')
    owner.active = False
    tick()
    hear('another')
    assert called == ['timer', 'a word']


def test_what_an_executor_had_in_hand_comes_to_nothing_once_the_end_is_closed(owner, opened):
    """The node may have been configured anew, and be active, by then."""
    ends, tick, hear, called = opened
    while ends:
        ends.pop()()
    tick()
    hear('too late')
    assert called == owner.told == []


def test_what_latched_topics_tell_an_inactive_node_it_hears_at_its_activation(owner):
    node, called = Node(), []
    ends = Ends(node, owner)
    ends.listen(String, 'map', called.append, LATCHED)
    owner.active = False
    for word in ('old', 'new'):
        node.callbacks[0](word)
    owner.active = True
    ends.hear()
    ends.hear()
    assert called == ['new']


@pytest.mark.parametrize(
    ('error', 'told'),
    [(SignalError('no number'), 'refused word: no number'), (ValueError(7), 'stopped for word: 7')],
)
def test_an_input_that_is_none_is_told_and_a_defect_stops_the_node(owner, error, told):
    def fail(_):
        raise error

    node = Node()
    Ends(node, owner).listen(String, 'word', fail, QoSProfile(depth=1))
    node.callbacks[0]('')
    assert owner.told == [told]
