"""The node that ros/README.md shows: written in thirty lines, run without middleware."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from types import ModuleType

import pytest

rclpy = pytest.importorskip('rclpy')

from std_msgs.msg import Float64

import agv_motion.ros
from agv_motion.errors import ConfigurationError
from agv_motion.ros.cdr import codec
from agv_motion.ros.diagnosis import OK
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.run import start

PAGE = (Path(agv_motion.ros.__file__).parent / 'README.md').read_text(encoding='utf-8')
FLOAT = codec(Float64)


@pytest.fixture
def page():
    """Return what the two examples define, the second run after the first."""
    node, test = re.findall(r'```python\n(.*?)```', PAGE, re.DOTALL)
    module = ModuleType('echo_of_the_page')
    sys.modules[module.__name__] = module
    found = vars(module)
    exec(node, found)  # noqa: S102 - our own page
    found |= {'InProcessGraph': InProcessGraph, 'InProcessNode': InProcessNode, 'codec': codec}
    exec(test, found)  # noqa: S102
    yield found
    del sys.modules[module.__name__]


def test_in_process(page):
    assert [FLOAT.decode(data).data for data in page['said']] == [3.0]


def test_live(page, graph):
    node = graph.add(LiveNode(page['Echo'], context=graph.context))
    tester = graph.node('tester')
    heard = []
    tester.create_subscription(Float64, 'out', heard.append, 10)
    publisher = tester.create_publisher(Float64, 'in', 10)
    start(node)
    graph.meet()
    publisher.publish(Float64(data=2.0))
    graph.spin_until(lambda: heard)
    assert heard[0].data == 4.0
    (answer,) = node.set_parameters([rclpy.Parameter('gain', value=0.5)])
    assert answer.successful
    assert node.plain.parameters.gain == 0.5
    assert node.plain.diagnose() == (OK, 'running', {}, None)


def test_what_a_node_has_not_is_named(page):
    graph = page['graph']
    with pytest.raises(ConfigurationError, match='echo has no parameter gian'):
        InProcessNode(graph, page['Echo'], {'gian': 1.0})
