"""The examples: each runs, tells what was calculated by hand, and is short enough to be read."""

from __future__ import annotations

import ast
import re
import runpy
from math import asin, atan2, degrees, hypot, sqrt
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[1] / 'launch_scripts' / 'examples'
EXAMPLES = sorted(FOLDER.glob('*.py'))
MOST_LINES = 40


@pytest.fixture
def told(capsys, tmp_path, monkeypatch):
    """Run the example of a number in an empty folder; return the lines that it prints."""
    monkeypatch.chdir(tmp_path)

    def run(number: int) -> list[str]:
        (path,) = FOLDER.glob(f'{number:02}_*.py')
        runpy.run_path(str(path), run_name='__main__')
        return capsys.readouterr().out.splitlines()

    return run


def numbers(line: str) -> list[float]:
    return [float(number) for number in re.findall(r'-?\d+(?:\.\d+)?', line)]


@pytest.mark.parametrize('path', EXAMPLES, ids=lambda path: path.stem)
def test_an_example_is_short_and_says_what_it_shows(path):
    text = path.read_text(encoding='utf-8')
    assert len(text.splitlines()) <= MOST_LINES
    assert ast.get_docstring(ast.parse(text))


def test_the_examples_are_numbered_and_each_has_a_test_of_its_numbers():
    given = [int(path.name[:2]) for path in EXAMPLES]
    assert len(set(given)) == len(given)
    tests = Path(__file__).read_text(encoding='utf-8')
    assert [number for number in given if f'told({number})' not in tests] == []


def test_01_turrets(told):
    lines = told(1)
    assert [numbers(line) for line in lines[1:4]] == [[0.0, 1.0]] * 3
    assert [numbers(line) for line in lines[5:8]] == [[90.0, 1.0]] * 3
    # square to their arms at -45, 45 and 180 degrees
    assert [numbers(line) for line in lines[9:12]] == [[45.0, 1.0], [135.0, 1.0], [-90.0, 1.0]]
    assert lines[12].endswith('scaled by 0.333')  # 2 / 6


def test_02_centre_of_rotation(told):
    lines = told(2)
    assert numbers(lines[0]) == [0.0, 1.0]  # (-vy / wz, vx / wz)
    assert numbers(lines[1]) == [45.0, 30.0, -45.0]
    assert numbers(lines[2]) == [0.01414, 0.0, 0.01414]  # 0.01 sqrt(2), and none at the ICR
    assert numbers(lines[4]) == [0.01, 0.0]
    # About the centroid (0, 1/3) of (1, 0), (0, 1), (-1, 0): sum |d|^2 = 8/3, and the wheels at
    # (0.01, 0.01), (0, 0) and (s, 0), s = 0.01 sqrt(2), have a moment of (0.04 + s) / 3.
    s = 0.01 * sqrt(2.0)
    wz = (0.04 + s) / 8.0
    vx, vy = (0.01 + s) / 3.0 + wz / 3.0, 0.01 / 3.0
    left = [(vx - 0.01, vy + wz - 0.01), (vx - wz, vy), (vx - s, vy - wz)]
    residual = sqrt(sum(x * x + y * y for x, y in left) / 3.0)
    assert numbers(lines[5]) == [round(wz, 4), round(residual, 4)] == [0.0068, 0.0041]


def test_03_steering(told):
    lines = told(3)
    times = [numbers(line)[0] for line in lines[:3]]
    # a quarter turn at 15 deg/s, 0.26 s to get going and to stop at 1 rad/s2; then 1/60 m/s at
    # 0.05 m/s2; each to the step of 0.05 s, one step to set out
    assert times[0] == 0.0
    assert 6.26 <= times[1] <= 6.26 + 0.1
    assert 0.3 <= times[2] - times[1] <= 0.4
    assert [line.split()[2] for line in lines[:3]] == ['AtRest', 'Rolling', 'Rolling']
    assert numbers(lines[3]) == [90.0] * 3
    assert numbers(lines[4]) == [1.0] * 3
    assert lines[5].endswith('left at 1.000 m/min')


def test_05_a_tree(told):
    lines = told(5)
    # the tangent from (5, 8) to the circle of margin and rim about the corner (9, 6)
    bearing = degrees(atan2(-2.0, 4.0) - asin(1.68 / hypot(4.0, 2.0)))
    assert numbers(lines[1]) == [round(bearing), 0.8, 0.0]
    assert numbers(lines[4]) == [round(bearing), 0.4, 0.5]
    corners = numbers(lines[2])
    assert corners[:2] == [5.0, 8.0]
    assert corners[-2:] == [15.0, 8.0]
    assert min(corners[1::2]) == 4.32  # 6 - 1.68
    assert lines[6].endswith('resting: the sap stands')
    assert len(lines) == 8
