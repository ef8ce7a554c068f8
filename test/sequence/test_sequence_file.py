"""Sequences from YAML: what each action means, and that errors name line, column and choices."""

from __future__ import annotations

from pathlib import Path

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.sequence.actions import DriveArc, FollowRoute, GoTo, Rotate, Wait
from agv_motion.sequence.sequence import OnFailure
from agv_motion.sequence.sequence_file import load_sequence

CONFIG = Path(__file__).parents[2] / 'config'


@pytest.fixture
def load(tmp_path):
    def loaded(text):
        path = tmp_path / 'mission.yaml'
        path.write_text(text)
        return load_sequence(path)

    return loaded


def test_the_example_is_read_as_it_stands():
    sequence = load_sequence(CONFIG / 'sequence_example.yaml')
    assert sequence.name == 'round trip'
    assert [type(step.action) for step in sequence.steps] == [
        GoTo, GoTo, Rotate, DriveArc, Wait, FollowRoute, GoTo,
    ]  # fmt: skip
    first, *_, last = sequence.steps
    assert first.action == GoTo(2.0, 1.0, 90.0, speed=0.4, acceleration=0.3)
    assert first.on_failure == OnFailure(retries=2)
    assert [step.timeout for step in sequence.steps] == [30, 30, 30, 20, 30, 60, 30]
    assert last.name == 'back home'
    assert last.action.backward


def test_defaults_give_way_to_what_an_action_says(load):
    sequence = load("""
defaults: {timeout: 5, on_failure: skip, rotate: {speed: 10}}
actions:
  - rotate: {by: 90}
  - {rotate: {by: 90, speed: 20}, timeout: 7, on_failure: retry 1 then skip}
""")
    first, second = sequence.steps
    assert (first.timeout, first.action.speed, first.on_failure) == (5, 10, OnFailure(0, skip=True))
    assert (second.timeout, second.action.speed) == (7, 20)
    assert second.on_failure == OnFailure(1, skip=True)


def test_what_nobody_says(load):
    sequence = load("""
actions:
  - wait: 1
  - {wait: 2, timeout: 1000000}
  - follow_route: {waypoints: [[0, 0], [1, 0]]}
""")
    assert sequence.name == 'mission'
    assert [step.timeout for step in sequence.steps] == [60.0, 1e6, 60.0]
    assert {step.on_failure for step in sequence.steps} == {OnFailure(0, skip=False)}
    assert [step.name for step in sequence.steps[:2]] == ['wait 1', 'wait 2']
    assert sequence.steps[2].action.route.laps == 1
    with pytest.raises(ConfigurationError, match=r'timeout = 1e\+06 s: must lie above 0, at most'):
        load('actions: [{wait: 1, timeout: 1000000.5}]')


def test_a_route_stands_in_the_sequence_or_beside_it(load, tmp_path):
    (tmp_path / 'r.csv').write_text('0,0\n3,0\n')
    sequence = load("""
actions:
  - follow_route: {waypoints: [[0, 0], [1, 0], [1, 1]], laps: 2}
  - follow_route: {file: r.csv}
""")
    first, second = (step.action.route for step in sequence.steps)
    assert (len(first.segments), first.laps) == (3, 2)
    assert second.length == 3.0


@pytest.mark.parametrize(
    ('text', 'where', 'reason'),
    [
        ('actions:\n  - goto: {x: 1}', '2:5', "unknown action 'goto', did you mean 'go_to'"),
        ('actions:\n  - dance: 1', '2:5', 'choose one of go_to, rotate, arc, follow_route, wait'),
        ('actions:\n  - wait: 1\n  - go_to: {x: 1, z: 2}', '3:19', "unknown key 'z'"),
        ('actions:\n  - go_to: {x: 1}', '2:12', "'y' is missing; it has x [m], y [m]"),
        ('actions:\n  - go_to: {x: 1, y: up}', '2:22', "go_to: y = 'up': expected a number"),
        ('actions:\n  - go_to: {x: .nan, y: 0}', '2:16', 'x = nan: must be a finite number'),
        ('actions:\n  - go_to: {x: 1, y: 1, speed: 0}', '2:32', 'speed = 0.0: must lie in'),
        ('actions:\n  - go_to: {x: 1, y: 1, speed: -1}', '2:32', 'speed = -1.0: must lie in'),
        ('actions:\n  - go_to: [1, 2]', '2:12', 'expected keys and values'),
        ('actions:\n  - rotate: {speed: 3}', '2:13', 'give one of the two'),
        ('actions:\n  - rotate: {by: 3, to: 4}', '2:18', 'give one of the two'),
        ('actions:\n  - rotate: {by: 3, by: 4}', '2:21', "'by' stands twice"),
        ('actions:\n  - arc: {angle: 90, diameter: -1}', '2:32', 'diameter = -1.0'),
        ('actions:\n  - wait: soon', '2:11', "wait = 'soon': expected a number"),
        ('actions:\n  - wait: -1', '2:11', 'seconds = -1.0: must lie in'),
        ('actions:\n  - wait: 1\n    timeout: 0', '3:14', 'timeout = 0 s: must lie above 0'),
        ('actions:\n  - wait: 1\n    timeout: yes', '3:14', 'timeout = True: expected a number'),
        ('actions:\n  - wait: 1\n    on_failure: cry', '3:17', 'choose one of stop, skip, retry N'),
        ('actions:\n  - wait: 1\n    retry: 2', '2:5', '2 actions in one item'),
        ('actions:\n  - timeout: 2', '2:5', '0 actions in one item'),
        ('actions:\n  - follow_route: {}', '2:19', 'give either file or waypoints'),
        ('actions:\n  - follow_route: {waypoints: [[0, 0]]}', '2:19', '1 waypoints'),
        ('actions:\n  - follow_route: {file: none.csv}', '2:19', 'cannot read the route'),
        ('actions: []', '1:10', 'the list is empty'),
        ('actions: go', '1:10', 'expected a list'),
        ('action: []', '1:1', "unknown key 'action', did you mean 'actions'"),
        ('name: x', '1:1', 'no actions'),
        ('[1, 2]', '1:1', 'expected keys and values'),
        ('defaults: {speed: 1}\nactions: [{wait: 1}]', '1:12', "defaults: unknown key 'speed'"),
        ('actions:\n  - wait: {', '3:1', 'no YAML'),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told_with_its_place(load, text, where, reason):
    line, column = where.split(':')
    with pytest.raises(ConfigurationError) as caught:
        load(text)
    assert f'mission.yaml, line {line}, column {column}: ' in str(caught.value)
    assert reason in str(caught.value)


def test_a_file_that_is_empty_or_not_there(load, tmp_path):
    with pytest.raises(ConfigurationError, match='the file is empty'):
        load('# nothing\n')
    with pytest.raises(ConfigurationError, match='cannot read'):
        load_sequence(tmp_path / 'none.yaml')


def test_an_action_is_called_as_people_would_say_it(load):
    sequence = load("""
actions:
  - go_to: {x: 1.5, y: -2}
  - follow_route: {waypoints: [[0, 0], [1, 0]], laps: 2}
  - {wait: 2, timeout: 0.5}
""")
    names = [step.name for step in sequence.steps]
    assert names == ['go_to x 1.5, y -2', 'follow_route laps 2', 'wait 2']
    assert sequence.steps[-1].timeout == 0.5


@pytest.mark.parametrize(('points', 'number'), [('[[x, 0], [1, 0]]', 1), ('[[0, 0], [1]]', 2)])
def test_a_waypoint_that_is_none_is_told_by_its_number(load, points, number):
    with pytest.raises(ConfigurationError, match=f'waypoint {number}'):
        load(f'actions:\n  - follow_route: {{waypoints: {points}}}\n')
