"""Routes from YAML and CSV, and every way in which a file can be wrong."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.route.route_file import load_route


def written(folder, name, text):
    path = folder / name
    path.write_text(text)
    return path


@pytest.mark.parametrize(
    ('name', 'text'),
    [
        ('r.yaml', 'waypoints: [[0, 0], [4.5, 0], [4, 3]]'),
        ('r.csv', 'x,y\n0,0\n4.5,0\n4,3\n'),
        ('r.csv', '0,0\n4.5,0\n\n4,3'),
        ('r.csv', 'time;y;x\n1;0;0\n2;0;4.5\n3;3;4\n'),
        ('r.txt', '# from the survey\n0 0\n4.5 0  # corner\n4\t3\n'),
    ],
)
def test_forms_of_one_route(tmp_path, name, text):
    route = load_route(written(tmp_path, name, text))
    assert route.waypoints == ((0, 0), (4.5, 0), (4, 3))
    assert route.laps == 1


def test_laps_of_the_file_and_of_the_caller(tmp_path):
    path = written(tmp_path, 'r.yml', 'waypoints: [[0, 0], [4, 0], [4, 3]]\nlaps: 3')
    assert load_route(path, laps=2).laps == 3
    path = written(tmp_path, 'r.csv', '0,0\n4,0\n4,3')
    assert load_route(path, laps=2).laps == 2


@pytest.mark.parametrize(
    ('name', 'text', 'reason'),
    [
        ('r.csv', 'x,y\n0,0\n1,b\n', r"r\.csv, line 3, column 3: '1,b' gives no x and y"),
        ('r.csv', 'x,y\n0,0\n1\n', r"line 3, column 2: '1' gives no x and y"),
        ('r.csv', '0,0,7\n', 'line 1, column 5: .* is no pair; name the columns'),
        ('r.csv', '1,5;2,0\n', 'line 1, column 1: .* gives no x and y'),
        ('r.csv', 'x,y\n0,0\n1,nan\n', 'line 3, column 3: .*must be finite'),
        ('r.csv', 'x,y\r\n0,0\r\n1, inf\r\n', 'line 3, column 4: .*must be finite'),
        ('r.csv', '0,0\n1,' + '9' * 400, 'line 2, column 3: .*must be finite'),
        ('r.csv', '0,0\n1,' + '9' * 100_000 + 'x', 'line 2, column 3: '),
        ('r.csv', '0,0\n1,1_0', 'line 2, column 3: '),
        ('r.csv', '0 0\n1  \u0663', 'line 2, column 4: '),
        ('r.csv', '', '0 waypoints'),
        ('r.yaml', 'waypoints: [[0, 0]]', '1 waypoints'),
        ('r.yaml', 'points: [[0, 0], [1, 1]]', 'expected waypoints and.* got points'),
        ('r.yaml', 'waypoints: [[0, 0], [1, 1]]\nlaps: twice', 'line 2, column 7: laps = '),
        ('r.yaml', 'waypoints: 3', 'line 1, column 12: waypoints: expected a list'),
        ('r.yaml', 'waypoints: [[0, 0], [1, a]]', 'line 1, column 25: waypoint 2: y = .a.:'),
        ('r.yaml', 'waypoints: [[0, 0], [1, .inf]]', 'line 1, column 25: .*must be a finite'),
        ('r.yaml', 'waypoints: [[0, 0], [1, 2, 3]]', 'line 1, column 21: waypoint 2 is'),
        ('r.yaml', 'waypoints: [[0, 0], [1, {a: 1}]]', 'line 1, column 25: '),
        ('r.yaml', 'waypoints: [[0, 0], [1, 1]]\nlaps: ' + '9' * 99, 'whole number of 64 bits'),
        ('r.yaml', '', 'the file is empty'),
        ('r.yaml', 'waypoints: [', 'line 2'),
        ('r.yaml', '[1, 2]', 'expected waypoints'),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named(tmp_path, name, text, reason):
    with pytest.raises(ConfigurationError, match=reason):
        load_route(written(tmp_path, name, text))


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(ConfigurationError, match='cannot read the route'):
        load_route(tmp_path / 'none.csv')
