"""Zones from files: YAML and drawings, the shipped ones, and what is refused with its place."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml

from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.motion.navigation.zone_file import load_zone

CONFIG = Path(__file__).parents[3] / 'config'
SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10]]
COLUMN = [[4, 4], [6, 4], [6, 6], [4, 6]]
MOSAIC = [[0, 0], [2, 0], [2, 2], [0, 2]]


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
        (
            'boundary: [[0, 0], [1, 1]]',
            GeometryError,
            'zone.yaml, line 1, column 11: boundary',
        ),
        ('border: []', ConfigurationError, 'expected boundary'),
        ('[1, 2', ConfigurationError, 'zone.yaml, line 2, column 1: no YAML'),
        (
            'boundary: [[0, 0], [9, 0, 1, 2], [9, 9]]',
            GeometryError,
            'column 20: boundary: corner',
        ),
        (
            'boundary: [[0, 0], [9, .inf], [9, 9]]',
            GeometryError,
            'column 24: boundary: corner',
        ),
        ('boundary: [0, [9, 0], [9, 9]]', GeometryError, 'column 12: boundary: corner 1'),
        ('boundary: 3', GeometryError, 'column 11: boundary: expected a list'),
        ('boundary: []', GeometryError, 'column 11: boundary has 0'),
        ('just words', ConfigurationError, 'expected boundary'),
        (
            '{boundary: [[0, 0], [9, 0], [9, 9]], margin: wide}',
            GeometryError,
            'column 46: margin = ',
        ),
        (
            '{boundary: [[0, 0], [9, 0], [9, 9]], home: 3}',
            GeometryError,
            'column 44: home: expected a',
        ),
        (
            '{boundary: [[0, 0], [9, 0], [9, 9]], holes: yes}',
            GeometryError,
            'column 45: holes: expected',
        ),
    ],
)
def test_a_file_that_is_no_zone_is_named(tmp_path, text, error, word):
    path = tmp_path / 'zone.yaml'
    path.write_text(text)
    with pytest.raises(error, match=word.replace('.', r'\.')):
        load_zone(path)


FAR, NEAR = '[[20, 20], [21, 20], [21, 21]]', '[[6, 2], [7, 2], [7, 3]]'


@pytest.mark.parametrize(
    ('parts', 'word'),
    [
        (f'holes: [{FAR}]', 'column 46: hole 1 lies outside'),
        (f'holes: [{NEAR}, {FAR}]', 'column 72: hole 2 lies outside'),
        (f'translation_only: [{FAR}]', 'column 57: translation-only area 1 touches no floor'),
        (f'translation_only: [{NEAR}, {FAR}]', 'column 83: translation-only area 2 touches no'),
    ],
)
def test_the_part_that_is_wrong_is_found_in_the_file(tmp_path, parts, word):
    path = tmp_path / 'zone.yaml'
    path.write_text(f'{{boundary: [[0, 0], [9, 0], [9, 9]], {parts}}}')
    with pytest.raises(GeometryError, match=word):
        load_zone(path, 0.1)


TRIANGLE = {'type': 'Polygon', 'coordinates': [[[0, 0], [9, 0], [9, 9]]]}


@pytest.mark.parametrize(
    ('features', 'word'),
    [
        ([{'geometry': None}], 'feature 1 is a None'),
        ([{'geometry': TRIANGLE}, {'geometry': TRIANGLE}], 'feature 2 is a Polygon of kind .zone'),
        ([{'geometry': {'type': 'MultiPolygon'}}], 'feature 1 is a MultiPolygon'),
        ([{'properties': {'kind': 'pond'}, 'geometry': TRIANGLE}], "kind 'pond'"),
        ([{'properties': {'kind': 'pond'}}], "kind 'pond'"),
        ([{'properties': {'kind': ['zone']}, 'geometry': TRIANGLE}], r"kind \['zone'\]"),
        ([{'properties': 3, 'geometry': TRIANGLE}], 'properties: expected keys and values'),
        ([{'geometry': {'type': 'Polygon'}}], 'each with coordinates'),
        ([{'geometry': {'type': 'Polygon', 'coordinates': 3}}], 'coordinates: expected a list'),
        ([7], 'feature 1: expected keys and values'),
        (7, 'features: expected a list'),
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


# The body, not a point


@pytest.mark.parametrize(
    ('text', 'clearance'),
    [
        ('', 0.5 + 1.18), ('margin: 0.2', 0.2 + 1.18), ('clearance_from: rim', 0.5 + 1.18),
        ('clearance_from: centre', 0.5), ('{margin: 0.3, clearance_from: centre}', 0.3),
    ],
)  # fmt: skip
def test_a_file_says_what_its_margin_counts_from(tmp_path, text, clearance):
    path = tmp_path / 'zone.yaml'
    path.write_text(f'boundary: {SQUARE}\n' + text.strip('{}').replace(', ', '\n'))
    assert load_zone(path).clearance == pytest.approx(clearance)
    drawing = {'type': 'Polygon', 'coordinates': [SQUARE]}
    properties = yaml.safe_load(text) or {}
    path = tmp_path / 'zone.geojson'
    path.write_text(json.dumps({'type': 'Feature', 'properties': properties, 'geometry': drawing}))
    assert load_zone(path).clearance == pytest.approx(clearance)
    assert load_zone(path, 0.3).rim == (0.0 if 'centre' in text else 0.3)


def test_another_way_to_count_is_refused(tmp_path):
    path = tmp_path / 'zone.yaml'
    path.write_text(f'boundary: {SQUARE}\nclearance_from: trunk\n')
    with pytest.raises(ConfigurationError, match=r"clearance_from = 'trunk': choose one of rim"):
        load_zone(path)


def test_the_shipped_zones_have_room_for_the_platform():
    """Indoors 12 m2 of 50, outdoors 194 m2 of 300, for the centre; the platform covers more."""
    areas = {}
    for name in ('zone_outdoor.yaml', 'zone_indoor.yaml'):
        (part,) = load_zone(CONFIG / name).parts
        areas[name] = part.area
        covered = part.buffer(1.18).area / load_zone(CONFIG / name).area
        assert covered > 0.75
    assert areas['zone_outdoor.yaml'] == pytest.approx((20 - 3.36) * (15 - 3.36))
    assert areas['zone_indoor.yaml'] > 12.0


PARIS = [[2.3522, 48.8566], [2.3525, 48.8566], [2.3525, 48.8568], [2.3522, 48.8568]]


@pytest.mark.parametrize('properties', [{}, {'margin': 0.0, 'clearance_from': 'centre'}])
def test_a_drawing_in_degrees_is_told_with_the_remedy(tmp_path, properties):
    path = tmp_path / 'zone.geojson'
    drawing = {'type': 'Polygon', 'coordinates': [PARIS]}
    path.write_text(json.dumps({'type': 'Feature', 'properties': properties, 'geometry': drawing}))
    with pytest.raises(ConfigurationError, match=r'look like degrees .* system such as UTM'):
        load_zone(path)


@pytest.mark.parametrize('origin', [(652_000, 6_862_000), (180.5, 0.0), (-180.5, 0.0), (0.0, 90.5)])
def test_a_drawing_in_the_metres_of_a_country_is_none_in_degrees(tmp_path, origin):
    """A degree wide or not: no place on Earth lies beyond 180 or 90 degrees."""
    path = tmp_path / 'zone.geojson'
    square = [[origin[0] + 0.09 * x, origin[1] + 0.09 * y] for x, y in SQUARE]
    drawing = {'type': 'Polygon', 'coordinates': [square]}
    bare = {'margin': 0.0, 'clearance_from': 'centre'}
    path.write_text(json.dumps({'type': 'Feature', 'properties': bare, 'geometry': drawing}))
    assert load_zone(path).area == pytest.approx(0.81)
