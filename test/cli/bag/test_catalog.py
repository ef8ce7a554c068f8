"""`agv bag index`, `find` and `stats` as they are typed."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

sys.path.append(str(Path(__file__).parents[2] / 'bag' / 'editing'))

import bags

from agv_motion.cli.bag.group import app


@pytest.fixture(scope='module')
def season(tmp_path_factory):
    folder = tmp_path_factory.mktemp('season')
    for number in range(3):
        bags.write(folder / f'bag{number}', start=1_714_521_600 + number * 3600)
    (folder / 'torn.mcap').write_bytes(b'no bag')
    return folder


def run(*words):
    found = CliRunner().invoke(app, list(map(str, words)))
    return found.exit_code, found.stdout


def test_an_index_names_the_damaged(season):
    status, text = run('index', season)
    assert status == 0
    assert '4 bags, ' in text
    assert '1 damaged' in text
    assert 'damaged: ' + str(season.resolve() / 'torn.mcap') in text


def test_what_is_found_is_told_with_its_times(season):
    status, text = run('find', season, '--topic', '/a', '--from', '2024-05-01T01:00')
    assert (status, text.count('bag1'), text.count('bag2'), text.count('bag0')) == (0, 1, 1, 0)
    status, text = run('find', season, '--where', "/b == 'word 4'", '--json')
    assert status == 0
    assert [Path(one['path']).name for one in json.loads(text)] == ['bag0', 'bag1', 'bag2']
    assert run('find', season, '--topic', '/gone')[0] == 1


def test_statistics(season):
    status, text = run('stats', season)
    assert status == 0
    assert '/map' in text
    assert '1 bags are damaged' in text
    status, text = run('stats', season, '--by', 'day', '--json')
    (day,) = json.loads(text)['amounts']
    assert (day['name'], day['bags'], day['messages'], day['gaps']) == ('2024-05-01', 3, 123, 2)
    assert run('stats', season, '--by', 'hour')[0] != 0
