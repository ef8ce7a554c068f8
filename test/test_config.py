"""The files of config/: what the platform is stands in one section, and reaches every node."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.differential import DifferentialDrive
from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.nodes.differential_simulator import DifferentialSimulator
from agv_motion.nodes.ghost_trajectory import GhostTrajectory
from agv_motion.nodes.route_follower import RouteFollowerNode
from agv_motion.nodes.sequence import SequenceNode
from agv_motion.ros.parameter_file import load_parameters
from agv_motion.ros.parameters import OF_THE_PLATFORM

CONFIG = Path(__file__).parents[1] / 'config'
FILES = [path for path in sorted(CONFIG.glob('*.yaml')) if 'ros__parameters' in path.read_text()]


def names(values):
    for name, value in values.items():
        yield name
        if isinstance(value, dict):
            yield from names(value)


@pytest.mark.parametrize('path', FILES, ids=lambda path: path.stem)
def test_the_platform_is_told_once(path):
    sections = {
        node: set(names(content['ros__parameters']))
        for node, content in yaml.safe_load(path.read_text()).items()
    }
    assert sections['/**'] <= OF_THE_PLATFORM
    again = {node: told & OF_THE_PLATFORM for node, told in sections.items() if node != '/**'}
    assert {node: told for node, told in again.items() if told} == {}


def test_a_track_that_is_told_once_reaches_every_node(tmp_path):
    content = yaml.safe_load((CONFIG / 'differential.yaml').read_text())
    content['/**']['ros__parameters'] |= {'track': 0.5, 'track_multiplier': 1.1}
    path = tmp_path / 'wide.yaml'
    path.write_text(yaml.safe_dump(content))
    for node in (DifferentialKinematics, DifferentialSimulator):
        given = load_parameters(path, node.name, node.takes)
        assert DifferentialDrive.of(given).track == pytest.approx(0.55)
    of = {node: load_parameters(path, node.name, node.takes)
          for node in (GhostTrajectory, RouteFollowerNode, SequenceNode)}  # fmt: skip
    assert of[GhostTrajectory].follow.ghost.track == pytest.approx(0.55)
    assert of[SequenceNode].tracking.ghost.track == pytest.approx(0.55)
    assert of[RouteFollowerNode].limits.track == pytest.approx(0.55)


@pytest.mark.parametrize(
    ('node', 'old', 'new'),
    [
        (GhostTrajectory, {'follow': {'ghost': {'track': 0.4}}}, 'track'),
        (SequenceNode, {'tracking': {'ghost': {'track': 0.4}}}, 'track'),
        (RouteFollowerNode, {'limits': {'track': 0.4}}, 'track'),
        (GhostTrajectory, {'follow': {'leash': {'ease': 0.4}}}, 'follow.pace.ease'),
    ],
)
def test_a_file_of_before_is_told_where_it_stands_now(tmp_path, node, old, new):
    path = tmp_path / 'old.yaml'
    path.write_text(yaml.safe_dump({f'/**/{node.name}': {'ros__parameters': old}}))
    with pytest.raises(ConfigurationError, match=f'any more; it is {new} now'):
        load_parameters(path, node.name, node.takes)
