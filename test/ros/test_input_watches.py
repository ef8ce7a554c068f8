"""Inputs of which none may be lost: which one is, and when to stop at once."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_port import InProcessPort, Place
from agv_motion.ros.input_watch import Freshness
from agv_motion.ros.input_watches import InputWatches

SECOND = 1_000_000_000


@pytest.fixture
def graph():
    return InProcessGraph(lambda *_: None, 100 * SECOND)


@pytest.fixture
def inputs(graph):
    port = InProcessPort(graph, Place('node', '/', {}), str)
    return InputWatches(port, Freshness(1.0, 3.0, 0.5), ('flow', 'pose'))


def test_both_must_have_come(inputs):
    assert inputs.lost == 'flow'
    inputs.note('flow')
    assert inputs.lost == 'pose'
    inputs.note('pose')
    assert inputs.lost == ''


def test_the_first_that_is_silent_is_named_and_told_once(graph, inputs):
    for name in ('flow', 'pose'):
        inputs.note(name)
    graph.now += 2 * SECOND
    inputs.note('pose')
    assert not inputs.look()
    graph.now += 2 * SECOND
    assert inputs.look()
    assert inputs.lost == 'flow'
    assert not inputs.look()
    graph.now += 2 * SECOND
    assert not inputs.look()
    inputs.note('flow')
    assert inputs.lost == 'pose'
    inputs.note('pose')
    assert inputs.lost == ''


def test_a_clock_that_cannot_be_believed_stops_at_every_look(inputs):
    for name in ('flow', 'pose'):
        inputs.note(name)
    inputs['flow']._port.clock.fault = 'the clock stands'  # noqa: SLF001 - the clock of the node
    assert inputs.look()
    assert inputs.look()


def test_who_begins_anew_waits_for_one_of_them(inputs):
    for name in ('flow', 'pose'):
        inputs.note(name)
    inputs.wait_for('flow')
    assert inputs.lost == 'flow'
    inputs.note('flow')
    assert inputs.lost == ''
