"""Zones of every kind hang together, and their doors are as narrow as they say."""

from __future__ import annotations

import random
from types import SimpleNamespace

import pytest
from shapely.geometry import Polygon

from agv_motion.errors import GeometryError
from agv_motion.kinematics.platform import PLATFORM_RADIUS
from agv_motion.simulation.trials import season_zones
from agv_motion.simulation.trials.season_zones import DOOR, MOST_TREES, ZONES, ZonePlan, plan_of

AREAS = {'square': 300.0, 'garden': 300.0, 'hall': 50.0, 'rooms': 105.0, 'house': 160.0}


@pytest.mark.parametrize('kind', ZONES)
def test_every_plan_hangs_together_and_has_its_size(kind):
    for seed in range(5):
        plan = plan_of(kind, seed)
        assert len(plan.zone().parts) == 1
        assert Polygon(plan.boundary).area == pytest.approx(AREAS[kind])
        for hole in plan.holes:
            assert Polygon(plan.boundary).covers(Polygon(hole))
    assert MOST_TREES[kind] >= 2


@pytest.mark.parametrize(('kind', 'walls'), [('rooms', [7.0]), ('house', [6.5, 13.0])])
def test_doors_are_the_least_that_the_platform_passes(kind, walls):
    depth = {'rooms': 7.0, 'house': 8.0}[kind]
    for seed in range(5):
        plan = ZONES[kind](random.Random(seed))  # noqa: S311 - no secret
        for wall in walls:
            solid = sum(
                max(y for _, y in hole) - min(y for _, y in hole)
                for hole in plan.holes
                if min(x for x, _ in hole) == wall
            )
            assert depth - solid == pytest.approx(DOOR)
    assert pytest.approx(2 * PLATFORM_RADIUS + 0.2) == DOOR


def test_furniture_of_a_garden_keeps_off_the_walls():
    for seed in range(5):
        plan = ZONES['garden'](random.Random(seed))  # noqa: S311 - no secret
        assert len(plan.holes) == 3
        inner = Polygon(plan.boundary).buffer(-2.4)
        assert all(inner.covers(Polygon(hole)) for hole in plan.holes)


def test_a_kind_that_never_hangs_together_is_told(monkeypatch):
    shut = [[(5.0, 0.0), (6.0, 0.0), (6.0, 5.0), (5.0, 5.0)]]
    cut = ZonePlan([(0.0, 0.0), (11.0, 0.0), (11.0, 5.0), (0.0, 5.0)], shut)
    monkeypatch.setitem(season_zones.ZONES, 'cut', lambda _: cut)
    with pytest.raises(GeometryError, match='no zone of kind cut from seed 3 hangs together'):
        plan_of('cut', 3)


@pytest.mark.parametrize(('choose', 'corner'), [(min, 0.3), (max, None)])
@pytest.mark.parametrize('kind', ['rooms', 'house'])
def test_a_door_leaves_a_hand_of_wall_on_either_side(kind, choose, corner):
    chance = SimpleNamespace(uniform=choose)
    below, above = ZONES[kind](chance).holes[:2]
    if corner:
        assert max(y for _, y in below) == pytest.approx(corner)
    else:
        depth = max(y for _, y in above)
        assert depth - min(y for _, y in above) == pytest.approx(0.3)
