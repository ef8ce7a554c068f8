"""Zones as text: one makes the other, by the door of zone files."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.motion.navigation.zone_file import load_zone
from agv_motion.motion.navigation.zone_text import same_floor, text_of_zone, zone_of_text

CONFIG = Path(__file__).parents[3] / 'config'


@pytest.mark.parametrize('name', sorted(p.name for p in CONFIG.glob('zone*.yaml')))
def test_the_text_of_a_zone_makes_the_same_zone(name):
    zone = load_zone(CONFIG / name, 1.18)
    again = zone_of_text(text_of_zone(zone), 1.18)
    assert text_of_zone(again) == text_of_zone(zone)
    assert again.rim == zone.rim
    assert [part.wkt for part in again.parts] == [part.wkt for part in zone.parts]


def test_geojson_is_understood():
    drawing = {'type': 'Polygon', 'coordinates': [[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]]]}
    assert zone_of_text(json.dumps(drawing), 1.0).area == 81.0
    degrees = {'type': 'Polygon', 'coordinates': [[[2.1, 48.1], [2.2, 48.1], [2.2, 48.2]]]}
    with pytest.raises(ConfigurationError, match='look like degrees'):
        zone_of_text(json.dumps(degrees), 1.0)


def test_what_is_wrong_is_quoted_to_whoever_sent_it():
    with pytest.raises(ConfigurationError, match="clearance_from = 'rimm': choose one of") as told:
        zone_of_text('{boundary: [[0, 0], [9, 0], [9, 9]], clearance_from: rimm}', 0.5)
    assert not told.value.unquoted


def test_floors_are_compared_and_no_margins_or_homes():
    one = text_of_zone(zone_of_text('{boundary: [[0, 0], [9, 0], [9, 9], [0, 9]]}', 1.0))
    other = text_of_zone(
        zone_of_text('{boundary: [[0, 0], [9, 0], [9, 9], [0, 9]], margin: 1, home: [5, 5]}', 2.0)
    )
    hole = text_of_zone(
        zone_of_text('{boundary: [[0, 0], [9, 0], [9, 9], [0, 9]],'
                     'holes: [[[4, 4], [5, 4], [5, 5]]]}', 0.5)
    )  # fmt: skip
    assert same_floor(one, other)
    assert not same_floor(one, hole)
    for nonsense in ('', 'null', '[' * 10_000, '{"boundary": 3}'):
        assert not same_floor(one, nonsense)
