"""`spin`: whatever the executor raises is told, and every node leaves its outputs safe."""

from __future__ import annotations

import pytest

rclpy = pytest.importorskip('rclpy')

from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn

from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.ros import run as run_module
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.run import EXECUTORS, declare, spin, start


class Node(LifecycleNode):
    """A node, not of ours, with a timer that fails, as a service of rclpy may."""

    def __init__(self, name, graph, fails=10**6):
        super().__init__(name, context=graph.context)
        graph.nodes.append(self)
        self.calls, self.fails, self.ended = 0, fails, False
        self.create_timer(0.01, self._on_timer)

    def _on_timer(self):
        self.calls += 1
        if self.calls <= self.fails:
            raise ZeroDivisionError

    def on_shutdown(self, _):
        self.ended = True
        return TransitionCallbackReturn.SUCCESS


@pytest.mark.parametrize('executor', EXECUTORS)
def test_an_exception_does_not_end_the_nodes(graph, executor):
    node = Node('failing', graph, fails=3)
    spin([node], lambda: node.calls >= 6, executor, graph.context)
    assert node.calls >= 6
    assert node.ended


def test_an_executor_that_does_nothing_but_fail_ends_with_the_error(graph, monkeypatch):
    monkeypatch.setattr(run_module, 'HOPELESS', 0.3)

    class Broken:
        def add_node(self, _):
            """Take it."""

        def spin_once(self, **_):
            raise ZeroDivisionError

    monkeypatch.setitem(EXECUTORS, 'events', lambda **_: Broken())
    node = Node('unlucky', graph)
    with pytest.raises(ZeroDivisionError):
        spin([node], lambda: False, context=graph.context)
    assert node.ended


def test_one_that_cannot_shut_down_keeps_no_other_from_it(graph):
    bad, shut, good = (Node(name, graph, fails=0) for name in ('bad', 'shut', 'good'))

    def fail():
        raise ZeroDivisionError

    bad.trigger_shutdown = fail
    shut.trigger_shutdown()
    spin([bad, shut, good], lambda: True, context=graph.context)
    assert good.ended


def test_how_a_node_is_run_counts_at_its_start_alone(graph):
    node = LiveNode(DifferentialKinematics, context=graph.context)
    graph.nodes.append(node)
    assert declare(node) == (True, 'events')
    for name, value in {'autostart': False, 'executor': 'single_threaded'}.items():
        (answer,) = node.set_parameters([rclpy.Parameter(name, value=value)])
        assert not answer.successful
        assert 'read-only' in answer.reason


def test_a_start_that_is_no_longer_wanted_stops_half_way():
    class Slow:
        done = ()

        def trigger_configure(self):
            self.done += ('configured',)
            return TransitionCallbackReturn.SUCCESS

        def trigger_activate(self):
            self.done += ('activated',)

    node = Slow()
    start(node, lambda: bool(node.done))
    assert node.done == ('configured',)
