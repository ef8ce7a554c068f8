"""Every verb of `agv bag` on bags that are damaged, odd or foreign: right, or an error."""

from __future__ import annotations

import csv
import random
from pathlib import Path

import pytest
from typer.testing import CliRunner

from agv_motion.bag.columns.table_files import LONGEST_NAME, file_names
from agv_motion.bag.metadata import Topic
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.cli.bag.group import app
from agv_motion.errors import AgvMotionError

FLOAT = 'std_msgs/msg/Float64'
LONG = '/' + 'long' * 75


def run(*arguments):
    """Return status and all that is told; a refusal counts as status 1, any other error fails."""
    result = CliRunner().invoke(app, [str(a) for a in arguments], catch_exceptions=True)
    if isinstance(result.exception, AgvMotionError):
        return 1, f'{result.output}{result.exception}'
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result.exit_code, result.output


def number(x):
    import struct

    return b'\0\1\0\0' + struct.pack('<d', x)


@pytest.fixture
def mixed(tmp_path):
    """Return a bag with topics of one file name, a long name, and one that is not of ROS."""
    with BagWriter(tmp_path / 'bag', chunk_size=60) as writer:
        names = ('/a/b', '/a__b', '/A/B', LONG)
        topics = [writer.add_topic(n, FLOAT, 'float64 data', type_hash='') for n in names]
        odd = writer.add(Topic('/json', 'Odd', '{}', '', (), 'jsonschema', 'json'))
        wide = writer.add_topic('/wide', 'a/msg/W', 'wstring w', type_hash='')
        for i in range(20):
            for k, topic in enumerate(topics):
                writer.write(topic, i * 10**8, number(10.0 * k + i))
        writer.write(odd, 0, b'{}')
        writer.write(wide, 0, bytes(8))
    return tmp_path / 'bag'


def test_each_topic_has_a_file_of_its_own_and_one_that_cannot_be_read_is_skipped(mixed, tmp_path):
    status, out = run('export', mixed, tmp_path / 'tables')
    assert status == 1
    assert '/json is skipped' in out
    assert '/wide is skipped' in out
    tables = {}
    for path in (tmp_path / 'tables').iterdir():
        with path.open() as file:
            tables[path.name] = [float(row['data']) for row in csv.DictReader(file)]
    assert sorted(tables.values()) == [[10.0 * k + i for i in range(20)] for k in range(4)]
    assert len(max(tables, key=len)) < LONGEST_NAME + 20
    assert run('export', mixed, tmp_path / 'one', '--topics', '/a/b')[0] == 0


def test_file_names_stay_as_they_are_where_they_can():
    assert file_names(['/odom', '/a/b']) == {'/odom': 'odom', '/a/b': 'a__b'}
    odd = file_names(['/', '/..', '/a b', '/ä', '/x/y', '/x__y', '/X/Y', LONG, f'{LONG}2'])
    assert len({name.lower() for name in odd.values()}) == len(odd)
    assert all(name.isascii() and '/' not in name and name.strip('.') for name in odd.values())


def test_an_error_about_a_topic_names_the_bag(mixed):
    for topic in ('/json', '/wide'):
        status, out = run('echo', mixed, topic)
        assert status == 1
        assert f'bag {mixed}, topic {topic}: messages of' in out


def test_what_is_not_of_ros_ends_neither_check_nor_diff(mixed):
    status, out = run('check', mixed)
    assert "encoded in 'json': values were not looked at" in out
    assert 'error: /wide' in out
    assert status == 1
    status, out = run('diff', mixed, mixed)
    assert status == 0, out


def test_topics_of_several_publishers_may_go_back_in_their_headers(tmp_path):
    text = 'std_msgs/Header header\n' + '=' * 80 + '\nMSG: std_msgs/Header\n'
    text += 'builtin_interfaces/Time stamp\nstring frame_id\n'
    expected = {'one': 1, 'five': 0}
    for name, publishers in (('one', 1), ('five', 5)):
        with BagWriter(tmp_path / name) as writer:
            topic = writer.add_topic('/a', 'a/msg/A', text, type_hash='')
            for i in range(50):
                header = b'\0\1\0\0' + (100 + i - i % publishers * 2 - (i == 30) * 3).to_bytes(
                    4, 'little'
                )
                data = header + bytes(4) + b'\1\0\0\0\0'
                writer.write(topic, i * 10**8, data, None, i // publishers + 1)
        status, out = run('check', tmp_path / name)
        assert 'header.stamp goes back' in out
        assert status == expected[name], out


VERBS = (['info'], ['echo', '/a'], ['hz'], ['gaps'], ['check'], ['plot', '/a/data'])


def sound(path):
    """Write a small bag of two files; return its messages."""
    with BagWriter(path, compression='lz4', chunk_size=100) as writer:
        topic = writer.add_topic('/a', FLOAT, 'float64 data', type_hash='')
        for i in range(24):
            writer.write(topic, i * 10**8, number(float(i)))
            if i == 11:
                writer.split()
    return 24


def spoilt(folder, rng):
    """Damage the files of a bag in one of many ways."""
    files = sorted(folder.iterdir())
    file = rng.choice([f for f in files if f.suffix == '.mcap'])
    data = bytearray(file.read_bytes())
    at = rng.randrange(len(data))
    kind = rng.randrange(8)
    if kind == 0:
        data[at] ^= 1 << rng.randrange(8)
    elif kind == 1:
        del data[at:]
    elif kind == 2:
        data[at : at + 8] = rng.randbytes(8)
    elif kind == 3:
        del data[at : at + 5]
    elif kind == 4:
        (folder / 'metadata.yaml').write_text('{' * rng.randrange(9))
    elif kind == 5:
        data = b'version https://git-lfs.github.com/spec/v1\n'
    elif kind == 6:
        data = b''
    if kind == 7:
        file.unlink()
    else:
        file.write_bytes(data)


@pytest.mark.parametrize('seed', range(12))
def test_status_0_only_when_nothing_was_lost(tmp_path, seed):
    rng = random.Random(seed)  # noqa: S311
    count = sound(tmp_path / 'bag')
    spoilt(tmp_path / 'bag', rng)
    try:
        with BagReader(tmp_path / 'bag') as bag:
            whole = [m.data for m in bag.messages()] == [number(float(i)) for i in range(count)]
    except AgvMotionError:
        whole = False
    for verb, *rest in VERBS:
        arguments = [*rest, '-o', tmp_path / 'a.png'] if verb == 'plot' else rest
        status, out = run(verb, tmp_path / 'bag', *arguments)
        assert 'Traceback' not in out
        if status:
            assert 'bag' in out
        elif verb in ('echo', 'check', 'plot'):
            assert whole, (verb, out)
    status, out = run('recover', tmp_path / 'bag', tmp_path / 'saved')
    if not status:
        with BagReader(tmp_path / 'saved') as saved:
            assert saved.message_count == count
    assert run('export', tmp_path / 'bag', tmp_path / 'tables')[0] or whole
    assert not list(Path(tmp_path / 'tables').glob('*.unfinished'))
