"""Zones: what lies where, margins, and drawings that are no zone."""

from __future__ import annotations

import json
from math import inf, nan
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.motion.zone import Zone
from agv_motion.motion.zone_file import load_zone

CONFIG = Path(__file__).parents[2] / 'config'
SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10]]
COLUMN = [[4, 4], [6, 4], [6, 6], [4, 6]]
MOSAIC = [[0, 0], [2, 0], [2, 2], [0, 2]]


@pytest.mark.parametrize(
    ('point', 'floor', 'walkable'),
    [
        ((1.0, 1.0), True, True), ((0.4, 5.0), True, False), ((5.0, 5.0), False, False),
        ((3.6, 5.0), True, False), ((3.4, 5.0), True, True), ((11.0, 5.0), False, False),
        ((0.0, 0.0), True, False),
    ],
)  # fmt: skip
def test_floor_and_margin(point, floor, walkable):
    zone = Zone(SQUARE, [COLUMN])
    assert zone.contains(*point) is floor
    assert zone.walkable(*point) is walkable
    assert zone.area == 96.0


def test_turning_is_not_allowed_on_delicate_floor():
    zone = Zone(SQUARE, translation_only=[MOSAIC])
    assert not zone.may_turn(1.0, 1.0)
    assert zone.may_turn(3.0, 3.0)


@given(st.floats(-5, 15), st.floats(-5, 15))
def test_the_nearest_walkable_point_is_walkable(x, y):
    zone = Zone(SQUARE, [COLUMN])
    px, py = zone.nearest_walkable(x, y)
    grown = Zone(SQUARE, [COLUMN], margin=0.5 - 1e-9)
    assert grown.walkable(px, py)
    if zone.walkable(x, y):
        assert (px, py) == pytest.approx((x, y), abs=1e-9)


def test_a_margin_may_part_the_zone():
    hourglass = [[0, 0], [4, 0], [4, 1.6], [6, 1.6], [6, 0], [10, 0], [10, 4], [6, 4], [6, 2.4],
                 [4, 2.4], [4, 4], [0, 4]]  # fmt: skip
    zone = Zone(hourglass)
    assert len(zone.parts) == 2
    assert zone.part_of(2.0, 2.0) is not zone.part_of(8.0, 2.0)
    assert len(Zone(hourglass, margin=0.3).parts) == 1


@pytest.mark.parametrize(
    ('arguments', 'word'),
    [
        ({'boundary': [[0, 0], [1, 1]]}, '2 different corners'),
        ({'boundary': [[0, 0], [4, 4], [4, 0], [0, 4]]}, 'boundary is no polygon'),
        ({'boundary': [[0, 0], [4, nan], [4, 0]]}, 'not finite'),
        ({'boundary': 'everywhere'}, r'list of \[x, y\]'),
        ({'boundary': [[0, 0, 1], [4, 4], [4, 0]]}, r'list of \[x, y\]'),
        ({'boundary': SQUARE, 'holes': [COLUMN, COLUMN]}, 'holes 1 and 2 overlap'),
        ({'boundary': SQUARE, 'holes': [[[20, 20], [21, 20], [21, 21]]]}, 'hole 1 lies outside'),
        ({'boundary': SQUARE, 'holes': [SQUARE]}, 'cover the whole zone'),
        (
            {'boundary': SQUARE, 'translation_only': [[[20, 20], [21, 20], [21, 21]]]},
            'area 1 touches no floor',
        ),
        ({'boundary': SQUARE, 'margin': 6.0}, 'leaves nothing'),
        ({'boundary': SQUARE, 'margin': -1.0}, 'margin = -1.0'),
        ({'boundary': SQUARE, 'holes': [COLUMN], 'home': (5, 5)}, 'home .* lies in hole 1'),
        ({'boundary': SQUARE, 'home': (50, 5)}, 'x from 0 to 10 m'),
        ({'boundary': SQUARE, 'home': (0.1, 5)}, 'nearer than the margin'),
        ({'boundary': SQUARE, 'home': [1]}, r'home must be \[x, y\]'),
        ({'boundary': SQUARE, 'home': [1, nan]}, r'home must be \[x, y\]'),
        ({'boundary': SQUARE, 'margin': inf}, 'margin = inf'),
        (
            {
                'boundary': SQUARE,
                'holes': [[[3, 0], [3.1, 0], [3.1, 9.5], [3, 9.5]]],
                'home': (1, 5),
            },
            'cannot be reached from the largest part',
        ),
    ],
)
def test_what_is_no_zone_is_told(arguments, word):
    with pytest.raises(GeometryError, match=word):
        Zone(**arguments)


@pytest.mark.parametrize('name', ['zone_outdoor.yaml', 'zone_indoor.yaml'])
def test_the_shipped_zones(name):
    zone = load_zone(CONFIG / name)
    assert zone.home is not None
    assert len(zone.parts) == 1


def test_geojson_says_the_same_as_yaml(tmp_path):
    path = tmp_path / 'zone.geojson'
    features = [
        {'properties': {}, 'geometry': {'type': 'Polygon', 'coordinates': [SQUARE, COLUMN]}},
        {
            'properties': {'kind': 'translation_only'},
            'geometry': {'type': 'Polygon', 'coordinates': [MOSAIC]},
        },
        {'properties': {'kind': 'home'}, 'geometry': {'type': 'Point', 'coordinates': [8, 8, 0]}},
    ]  # fmt: skip
    path.write_text(json.dumps({'type': 'FeatureCollection', 'features': features}))
    zone = load_zone(path)
    assert zone.area == 96.0
    assert not zone.may_turn(1.0, 1.0)
    assert zone.home == (8.0, 8.0)


@pytest.mark.parametrize(
    ('text', 'error', 'word'),
    [
        ('boundary: [[0, 0], [1, 1]]', GeometryError, 'zone.yaml: boundary has 2'),
        ('border: []', ConfigurationError, 'expected boundary'),
        ('[1, 2', ConfigurationError, 'cannot read the zone'),
        ('just words', ConfigurationError, 'expected boundary'),
        ('{boundary: [[0, 0], [9, 0], [9, 9]], margin: wide}', GeometryError, 'zone.yaml'),
        ('{boundary: [[0, 0], [9, 0], [9, 9]], home: 3}', GeometryError, 'zone.yaml: home must'),
        ('{boundary: [[0, 0], [9, 0], [9, 9]], holes: yes}', GeometryError, 'holes must be a list'),
    ],
)
def test_a_file_that_is_no_zone_is_named(tmp_path, text, error, word):
    path = tmp_path / 'zone.yaml'
    path.write_text(text)
    with pytest.raises(error, match=word.replace('.', r'\.')):
        load_zone(path)


TRIANGLE = {'type': 'Polygon', 'coordinates': [[[0, 0], [9, 0], [9, 9]]]}


@pytest.mark.parametrize(
    ('features', 'word'),
    [
        ([{'geometry': None}], 'feature 1 is a None'),
        ([{'geometry': TRIANGLE}, {'geometry': TRIANGLE}], 'feature 2 is a Polygon of kind .zone'),
        ([{'geometry': {'type': 'MultiPolygon'}}], 'feature 1 is a MultiPolygon'),
        ([{'properties': {'kind': 'pond'}, 'geometry': TRIANGLE}], "kind 'pond'"),
        ([], 'expected boundary'),
    ],
)
def test_a_drawing_that_is_no_zone_is_told(tmp_path, features, word):
    path = tmp_path / 'zone.geojson'
    path.write_text(json.dumps({'type': 'FeatureCollection', 'features': features}))
    with pytest.raises(ConfigurationError, match=word):
        load_zone(path)


def test_a_file_that_is_not_there_is_named():
    with pytest.raises(ConfigurationError, match='cannot read the zone'):
        load_zone('nowhere.yaml')
