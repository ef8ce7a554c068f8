"""One tree of a season: its error, its steps and its tally, with a pilot of our own."""

from __future__ import annotations

import random
import statistics
from itertools import pairwise
from math import hypot
from types import SimpleNamespace

import pytest

from agv_motion.motion.command.polar import LINEAR_SPEED, STILL
from agv_motion.planar import Pose
from agv_motion.simulation.trials import season_tree
from agv_motion.simulation.trials.season_tree import ERROR_TIME, STEPPED, SeasonTree

NOON = 16600 * 86400.0 + 11 * 3600.0


class OnePilot:
    """Wants what it is given, and notes where it is told to be."""

    def __init__(self, *_):
        self.wanted, self.path, self.goal, self.told = STILL, (), None, []

    def update(self, _now, pose, _flow, _stamp):
        self.told.append(pose)
        return SimpleNamespace(wanted=self.wanted, path=self.path, goal=self.goal)


@pytest.fixture
def tree(monkeypatch):
    monkeypatch.setattr(season_tree, 'Pilot', OnePilot)
    chance = random.Random(1)  # noqa: S311 - no secret
    tree = SeasonTree('ash', None, None, (2.0, 3.0), chance)
    tree.pose = Pose(2.0, 3.0, 0.0)
    tree.pilot = tree._pilot  # noqa: SLF001 - ours
    return tree


def live(tree, now, step=1.0, deviation=0.0):
    return tree.live(now, lambda _x, _y: 1.0, step, deviation)


def test_the_error_keeps_its_size_however_long_the_steps(tree):
    """Fresh noise makes up for what is forgotten: the deviation stays, and never beyond three."""
    for k in range(3000):
        live(tree, NOON + k, step=ERROR_TIME, deviation=0.2)
    errors = [pose.x - 2.0 for pose in tree.pilot.told[100:]]
    assert statistics.stdev(errors) == pytest.approx(0.2, rel=0.08)
    assert max(hypot(p.x - 2.0, p.y - 3.0) for p in tree.pilot.told) <= 0.6 + 1e-9
    apart = [b - a for a, b in pairwise(errors)]
    assert statistics.stdev(apart) == pytest.approx(0.2 * (2 * (1 - 0.3679)) ** 0.5, rel=0.1)


def test_without_error_it_is_told_where_it_is(tree):
    live(tree, NOON)
    assert tree.pilot.told == [Pose(2.0, 3.0, 0.0)]


def test_it_goes_no_further_than_to_the_next_corner(tree):
    tree.pilot.wanted = STILL._replace(v=1.0)
    tree.pilot.path = ((2.0, 3.0), (2.02, 3.0), (9.0, 3.0))
    assert live(tree, NOON, step=10.0)
    assert tree.pose.x == pytest.approx(2.02)
    tree.pilot.path = ((2.02, 3.0), (9.0, 3.0))
    live(tree, NOON + 10.0, step=10.0)
    assert tree.pose.x == pytest.approx(2.02 + 10.0 * LINEAR_SPEED)
    assert tree.walked == pytest.approx(0.02 + 10.0 * LINEAR_SPEED)


def test_who_is_told_to_stand_stands(tree):
    assert not live(tree, NOON)
    assert (tree.pose, tree.walked) == (Pose(2.0, 3.0, 0.0), 0.0)


def test_standing_counts_only_with_somewhere_to_go(tree):
    tree.count_from(NOON)
    for k in range(10):
        live(tree, NOON + k)
    assert tree.longest_stand == 0.0
    tree.pilot.goal, tree.pilot.path = SimpleNamespace(objective=None), ((2.0, 3.0), (9.0, 3.0))
    for k in range(10, 16):
        live(tree, NOON + k)
    assert tree.longest_stand == pytest.approx(6.0)
    tree.pose = tree.pose._replace(x=2.0 + 1.5 * STEPPED)
    live(tree, NOON + 16)
    live(tree, NOON + 17)
    assert tree.longest_stand == pytest.approx(6.0)


def test_goals_are_counted_once_and_those_without_objective_not(tree):
    for k, objective in enumerate((None, 'sun', 'sun')):
        tree.pilot.goal = SimpleNamespace(objective=objective)
        live(tree, NOON + 2 * k)
        live(tree, NOON + 2 * k + 1)
    assert tree.goals == 2
