"""The body of the tree, not a point: where its rim is over an edge it stands, and says so."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from agv_motion.errors import ConfigurationError
from agv_motion.nodes.steering_parameters import WheelKinematicsParameters
from agv_motion.ros.run import StartError

YARD = """
boundary: [[0, 0], [20, 0], [20, 10], [0, 10]]
holes: [[[9, 4], [11, 4], [11, 6], [9, 6]]]
"""


@pytest.fixture
def walk(make_senses, tmp_path):
    """Return what makes a tree that is to go to a goal in the yard."""
    path = tmp_path / 'zone.yaml'

    def made(extra='', **given):
        path.write_text(YARD + extra)
        return make_senses(zone_file=str(path), **({'goal': [5.0, 5.0]} | given))

    return made


@pytest.mark.parametrize(
    ('place', 'radius', 'word'),
    [
        ((1.0, 5.0), 0.0, 'has the rim 0.18 m over an edge'),
        ((8.0, 5.0), 0.0, 'has the rim 0.18 m over an edge'),
        ((1.5, 5.0), 2.0, 'has the rim 0.50 m over an edge'),
    ],
)
def test_a_rim_over_an_edge_or_a_bench_stops_the_tree(walk, place, radius, word):
    senses = walk(platform_radius=radius)
    senses.stand(*place, 0.0)
    senses.feel(0.9, 0.5, 0.5)
    senses.tester.wait(senses.states, lambda m: word in m.data)
    assert not any(senses.moving(command) for command in senses.commands)


def test_counted_from_the_centre_as_the_original_did_it_walks(walk):
    senses = walk('clearance_from: centre\n')
    senses.stand(1.0, 5.0, 0.0)
    senses.feel(0.9, 0.5, 0.5)
    senses.moves()


def test_a_goal_at_which_the_rim_would_touch_is_refused(walk, capfd):
    with pytest.raises(StartError):
        walk(goal=[7.5, 5.0])
    assert 'beside the rim of 1.18 m to an edge' in capfd.readouterr().err


def test_a_platform_too_wide_for_the_zone_is_told(walk, capfd):
    with pytest.raises(StartError):
        walk(platform_radius=6.0)
    assert 'beside the rim of 6 m leaves nothing of the zone' in capfd.readouterr().err


def test_a_turret_outside_the_rim_stops_the_wheels_from_starting():
    with pytest.raises(ConfigurationError, match='outside platform_radius = 1 m'):
        WheelKinematicsParameters(platform_radius=1.0).turret_positions()
