"""Fixtures: a real ROS graph of this process, on its own domain."""

from __future__ import annotations

import os
import time
from pathlib import Path

os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
os.environ['ROS_DOMAIN_ID'] = str(1 + os.getpid() % 100)
# shared memory left by a killed process can swallow messages of the next one on its port
os.environ['FASTDDS_BUILTIN_TRANSPORTS'] = 'UDPv4'

import pytest
from hypothesis import settings

settings.register_profile('agv_motion', deadline=None, derandomize=True)
settings.load_profile('agv_motion')


class Graph:
    """Nodes on one executor, spun by the test itself: no threads, no sleeps."""

    def __init__(self, context):
        """Start with no node."""
        from rclpy.executors import SingleThreadedExecutor

        self.context = context
        self.nodes = []
        self.executor = SingleThreadedExecutor(context=context)

    def add(self, node):
        """Spin ``node`` with the others, and destroy it at the end of the test."""
        self.nodes.append(node)
        self.executor.add_node(node)
        return node

    def spin_until(self, condition, timeout=20.0):
        """Spin until ``condition()``; fail after ``timeout`` seconds."""
        end = time.monotonic() + timeout
        while not condition():
            assert time.monotonic() < end, 'timed out'
            self.executor.spin_once(timeout_sec=0.05)

    def spin_for(self, seconds):
        """Spin for a while: the only way to see that nothing comes."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.executor.spin_once(timeout_sec=0.02)


@pytest.fixture
def graph():
    """Return a fresh graph; everything in it is gone after the test."""
    rclpy = pytest.importorskip('rclpy')
    context = rclpy.Context()
    rclpy.init(context=context)
    graph = Graph(context)
    yield graph
    graph.executor.shutdown()
    for node in graph.nodes:
        node.destroy_node()
    rclpy.shutdown(context=context)


SPRUCE = 'granier_spruce_2012_2014.csv'


@pytest.fixture(scope='session')
def spruce():
    """Return the path of the real recording, where it is beside the repository."""
    root = Path(__file__).resolve().parents[1]
    for folder in (os.environ.get('AGV_MOTION_DATA'), root.parent / 'shared' / 'data'):
        if folder and (Path(folder) / SPRUCE).exists():
            return Path(folder) / SPRUCE
    pytest.skip(f'{SPRUCE} is not here: set AGV_MOTION_DATA to its folder')
    return None
