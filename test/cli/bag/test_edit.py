"""`agv bag cut`, `filter`, `merge`, `split`, `compress`, `sort`: each says what it did."""

from __future__ import annotations

import re

import pytest
import zstandard
from typer.testing import CliRunner

from agv_motion.bag import BagReader, BagWriter
from agv_motion.cli.bag.group import app
from agv_motion.errors import AgvMotionError

SECOND = 10**9


def run(*arguments):
    """Return status and all that is told; a refusal counts as status 1, any other error fails."""
    result = CliRunner().invoke(app, [str(a) for a in arguments], catch_exceptions=True)
    if isinstance(result.exception, AgvMotionError):
        return 1, f'{result.output}{result.exception}'
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result.exit_code, result.output


def write(folder, first=0):
    with BagWriter(folder, chunk_size=100) as bag:
        a, b = (bag.add_topic(n, 'a/msg/A', 'int8 data', type_hash='') for n in ('/a', '/b'))
        for i in range(20):
            bag.write((a, b)[i % 2], (100 + first + i) * SECOND, b'\0\1\0\0' + bytes((i,)))
    return folder


@pytest.fixture(scope='module')
def walk(tmp_path_factory):
    return write(tmp_path_factory.mktemp('bags') / 'walk')


def stamps(path, topics=None):
    with BagReader(path) as bag:
        return [m.stamp // SECOND - 100 for m in bag.messages(topics)]


@pytest.mark.parametrize(('command', 'expected'), [
    (('cut', '--from', '5', '--to', '8'), [5, 6, 7]),
    (('cut', '--from', '-2'), [17, 18, 19]),
    (('cut', '--start-offset', '5', '--playback-duration', '2'), [5, 6]),
    (('cut', '--to', '00:01:43'), [0, 1, 2]),
    (('cut', '--around', '/a > 13', '--before', '1', '--after', '0', '--topics', '/a'),
     [14, 16, 18]),
    (('filter', '--topics', '/a'), list(range(0, 20, 2))),
    (('filter', '-x', 'a'), list(range(1, 20, 2))),
    (('compress', '--compression', 'none'), list(range(20))),
    (('split', '-d', '7'), list(range(20))), (('split', '-b', '0.0005'), list(range(20))),
    (('sort',), list(range(20))),
])  # fmt: skip
def test_what_is_left(walk, tmp_path, command, expected):
    verb, *options = command
    status, out = run(verb, walk, tmp_path / 'new', *options)
    assert status == 0, out
    assert stamps(tmp_path / 'new') == expected
    assert re.search(rf'new: {len(expected)} messages.* kB -> .* kB, .* s \(\d+ chunks', out), out


def test_merge(walk, tmp_path):
    other = write(tmp_path / 'other', first=30)
    status, out = run('merge', walk, other, tmp_path / 'both')
    assert status == 0, out
    assert stamps(tmp_path / 'both') == [*range(20), *range(30, 50)]
    assert run('merge', walk, tmp_path / 'x')[0] == 1


def test_a_folder_of_bags_by_processes(tmp_path):
    for name in ('one', 'two', 'three'):
        write(tmp_path / 'season' / name)
    (tmp_path / 'season' / 'three' / 'three_0.mcap').write_bytes(b'nothing')
    command = ('filter', tmp_path / 'season', tmp_path / 'new', '--topics', '/a', '--workers', 2)
    status, out = run(*command)
    assert status == 1
    assert 'three_0.mcap' in out
    assert stamps(tmp_path / 'new' / 'one') == stamps(tmp_path / 'new' / 'two')
    assert sorted(path.name for path in (tmp_path / 'new').iterdir()) == ['one', 'two']


@pytest.mark.parametrize(('command', 'words'), [
    (('cut',), 'nothing to cut'), (('filter',), 'nothing to filter'),
    (('split',), 'give one of them'), (('filter', '--topics', '/c'), '/a'),
    (('cut', '--from', '1', '--start-offset', '2'), 'give one of the pairs'),
    (('compress', '--compression', 'gzip'), 'choose one of zstd, lz4, none'),
    (('cut', '--from', '100'), 'nothing was recorded'),
    (('filter', '-e', '('), 'regular expression'),
    (('cut', '--around', 'residual'), 'is no condition'),
])  # fmt: skip
def test_what_is_asked_wrongly_leaves_nothing(walk, tmp_path, command, words):
    verb, *options = command
    status, out = run(verb, walk, tmp_path / 'new', *options)
    assert status == 1
    assert words in out
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize('verb', ['cut', 'filter', 'merge', 'split', 'compress', 'sort'])
def test_help_teaches_by_examples(verb):
    status, out = run(verb, '-h')
    assert status == 0
    assert f'agv bag {verb} ' in out


def test_a_file_shorter_than_a_nanosecond_is_no_file_of_all(walk, tmp_path):
    status, out = run('split', walk, tmp_path / 'new', '-d', '1e-12')
    assert status == 1
    assert 'files of 1e-12 s each: expected at most' in out


def test_nothing_is_drawn_of_a_time_without_messages(walk, tmp_path):
    status, out = run('plot', walk, '/a/data', '--start-offset', '100', '-o', tmp_path / 'a.png')
    assert status == 1
    assert 'has no message on /a in this time' in out


def test_a_table_that_is_compressed_as_a_whole_is_told_as_sqlite3(walk, tmp_path):
    assert run('convert', walk, tmp_path / 'new')[0] == 0
    packed = tmp_path / 'new_0.db3.zstd'
    packed.write_bytes(zstandard.compress((tmp_path / 'new' / 'new_0.db3').read_bytes()))
    status, out = run('info', packed)
    assert status == 0, out
    assert 'Storage id:        sqlite3' in out
