"""`agv why` as a person uses it: a robot on the graph, and none."""

from __future__ import annotations

import json

import pytest

pytest.importorskip('rclpy')

from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.run import overrides, start

pytestmark = pytest.mark.usefixtures('apart')


def test_without_a_robot_it_says_so(alone):
    status, out, errors = alone('why', '--once')
    assert status == 1
    assert not out
    assert errors.startswith('error: no robot on the graph: start one')
    assert errors.count('\n') == 1


@pytest.fixture
def beside_oak(agv, graph):
    """Return the command beside two nodes of a tree: its probes learn, so it rests."""
    arguments = ['--ros-args', '-r', '__ns:=/oak']
    for kind in (GranierProbe, MotionGenerator):
        node = LiveNode(
            kind, context=graph.context, cli_args=arguments,
            parameter_overrides=overrides(**LEARNING if kind is GranierProbe else {}),
        )  # fmt: skip
        graph.add(node)
        start(node)
    graph.meet()
    return agv


LEARNING = {'warm_up_days': 0.0, 'simulated__period': 0.1}


def test_a_tree_whose_probes_learn(beside_oak):
    """No node `why` runs, and no wheels: it says what it hears, and the cause of the rest."""
    for _ in range(20):  # until all probes have been read
        status, out, errors = beside_oak('why', '--once')
        if 'no reading' not in out:
            break
    assert status == 0, errors
    assert out.startswith('oak: nothing is heard of the wheels: start their')
    words = ' '.join(out.split())
    assert '> wheels STALE nothing is heard of the wheels' in words
    assert 'probe_2 WARN probe 2 is learning' in words
    assert '-> wait: it learns zero flow in a night and its range in a day' in words
    assert max(map(len, out.splitlines())) <= 80
    assert '\x1b' not in out, 'no colours into a pipe'


def test_as_json_a_line_a_robot(beside_oak):
    status, out, errors = beside_oak('why', 'oak', '--json')
    assert status == 0, errors
    told = json.loads(out)
    assert told['robot'] == 'oak'
    decision = next(link for link in told['links'] if link['name'] == 'decision')
    assert (decision['level'], decision['because']) == ('WARN', 'sap flow')


def test_a_robot_that_is_not_there_is_told_with_those_that_are(beside_oak):
    status, _, errors = beside_oak('why', 'oat')
    assert status == 1
    assert "no robot 'oat' on the graph; did you mean 'oak'?; there are: oak" in errors
