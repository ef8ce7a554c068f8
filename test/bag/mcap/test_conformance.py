"""The conformance suite of the MCAP project, where it lies beside the repository: all is valid."""

from __future__ import annotations

import json
import os
import tarfile
from pathlib import Path

import pytest

from agv_motion.bag.editing.edit import Edit, edit
from agv_motion.bag.editing.recovery import Recovery
from agv_motion.bag.editing.to_sqlite import edit_to_sqlite
from agv_motion.bag.mcap import records
from agv_motion.bag.reader import BagReader
from agv_motion.bag.selection import Selection
from agv_motion.bag.writer import BagWriter

SUITE = 'mcap_conformance.tar.gz'


def _archive():
    root = Path(__file__).resolve().parents[3]
    folders = [os.environ.get('AGV_MOTION_DATA'), root.parent / 'shared' / 'data']
    return next((Path(f) / SUITE for f in folders if f and (Path(f) / SUITE).exists()), None)


@pytest.fixture(scope='module')
def suite(tmp_path_factory):
    """Return the files of the suite, each with the JSON beside it."""
    archive = _archive()
    if archive is None:
        pytest.skip(f'{SUITE} is not here: set AGV_MOTION_DATA to its folder')
    folder = tmp_path_factory.mktemp('suite')
    with tarfile.open(archive) as packed:
        packed.extractall(folder, filter='data')
    files = sorted(folder.rglob('*.mcap'))
    assert len(files) == 416
    return files


def _records(file, kind):
    told = json.loads(file.with_suffix('.json').read_text(encoding='utf-8'))
    return [dict(r['fields']) for r in told['records'] if r['type'] == kind]


def _expected(file):
    """Return what the JSON beside a file says: messages in the order of log time."""
    channels = {c['id']: c for c in _records(file, 'Channel')}
    schemas = {s['id']: s for s in _records(file, 'Schema')}
    messages = []
    for message in _records(file, 'Message'):
        channel = channels[message['channel_id']]
        schema = schemas.get(channel['schema_id'], {'name': '', 'encoding': '', 'data': []})
        messages.append(
            (
                *(int(message[key]) for key in ('log_time', 'publish_time', 'sequence')),
                bytes(int(byte) for byte in message['data']),
                *(channel[key] for key in ('topic', 'message_encoding')),
                *(schema[key] for key in ('name', 'encoding')),
                bytes(int(byte) for byte in schema['data']).decode(),
            )
        )
    return sorted(messages, key=lambda message: message[0])


def test_every_file_is_read_as_the_suite_says(suite):
    wrong = {}
    for file in suite:
        expected = _expected(file)
        with BagReader(file) as bag:
            found = [
                (
                    *(m.stamp, m.publish, m.sequence, m.data),
                    *(m.connection.topic, m.connection.encoding),
                    *(m.connection.type, m.connection.definition_encoding),
                    m.connection.definition,
                )
                for m in bag.messages()
            ]
            count = bag.message_count
            span = (bag.start, bag.end) if expected else (0, 0)
            problems = bag.problems
        times = [message[0] for message in expected] or [0]
        sound = found == expected and count == len(expected) and not problems
        if not sound or span != (times[0], times[-1]):
            wrong[file.stem] = (len(found), count, len(expected), span, problems)
    assert not wrong


def _content(path):
    """Return all that a bag holds but for what rosbag2 says of itself."""
    with BagReader(path) as bag:
        assert [str(problem) for problem in bag.problems] == []
        extras = [e for f in bag.files for e in f.extras() if getattr(e, 'name', '') != 'rosbag2']
        messages = [
            (m.stamp, m.publish, m.sequence, m.data, m.connection.topic, m.connection.type,
             m.connection.encoding, m.connection.definition, m.connection.notes)
            for m in bag.messages()
        ]  # fmt: skip
        return messages, extras, set(bag.connections)


def test_every_file_is_kept_by_filter_split_and_the_merge_of_its_halves(
    suite, tmp_path, monkeypatch
):
    """Every 13th file, unless AGV_MOTION_LONG is set: then all, in a minute or two."""
    monkeypatch.setattr(os, 'fsync', lambda _: None)  # the disk would be what takes time
    for number, file in enumerate(suite if 'AGV_MOTION_LONG' in os.environ else suite[::13]):
        expected = _content(file)
        with BagReader(file) as bag:
            begin, end = bag.start, bag.end + 1
            middle = (begin + end) // 2
            folder = tmp_path / str(number)
            folder.mkdir()
            halves = folder / 'first', folder / 'second'
            edit([bag], folder / 'filter', Edit(topics=Selection(regex='.*', everything=True)))
            edit([bag], folder / 'split', Edit(parts=((begin, middle), (middle, end))))
            edit([bag], halves[0], Edit(spans=((begin, middle),)))
            edit([bag], halves[1], Edit(spans=((middle, 2**64),)))
        with BagReader(halves[0]) as one, BagReader(halves[1]) as other:
            edit([one, other], folder / 'merge', Edit(compression='zstd'))
        for name in ('filter', 'split', 'merge'):
            assert _content(folder / name) == expected, (file.name, name)


def _in_sqlite3(content):
    """Return what sqlite3 can hold of a bag's content."""
    messages, extras, connections = content
    return [(m[0], *m[3:8]) for m in messages], extras, {c[:5] for c in connections}


def test_every_file_is_kept_by_convert_there_and_back(suite, tmp_path, monkeypatch):
    """Every 13th file, unless AGV_MOTION_LONG is set; all but what sqlite3 has no place for."""
    monkeypatch.setattr(os, 'fsync', lambda _: None)
    for number, file in enumerate(suite if 'AGV_MOTION_LONG' in os.environ else suite[::13]):
        expected = _in_sqlite3(_content(file))
        there, back = tmp_path / f'there_{number}', tmp_path / f'back_{number}'
        with BagReader(file) as bag:
            edit_to_sqlite([bag], there, Edit())
        with BagReader(there) as bag:
            edit([bag], back, Edit())
        assert _in_sqlite3(_content(there)) == expected, file.name
        assert _in_sqlite3(_content(back)) == expected, file.name


def _whole(data, first):
    """Return stamps of messages, and numbers of attachments and metadata, whole in the bytes."""
    found, position = [], first
    while position + records.PREFIX.size <= len(data):
        opcode, length = records.PREFIX.unpack_from(data, position)
        body, position = position + records.PREFIX.size, position + records.PREFIX.size + length
        if opcode == records.CHUNK:  # those of the suite are not compressed
            found += _whole(data[: min(position, len(data))], body + 8 + 8 + 8 + 4 + 4 + 8)
        elif position <= len(data) and opcode in _KEPT:
            stamp = records.MESSAGE_HEAD.unpack_from(data, body - records.PREFIX.size)[4]
            found.append(stamp if opcode == records.MESSAGE else _KEPT[opcode])
        elif opcode == records.DATA_END and position <= len(data):
            break
    return found


_KEPT = {records.MESSAGE: '', records.ATTACHMENT: 'attachment', records.METADATA: 'metadata'}


def test_of_a_file_cut_off_anywhere_all_that_lies_whole_is_saved(suite, tmp_path):
    """Every byte of all files takes hours: eight places in each 37th file here."""
    for number, file in enumerate(suite[::37]):
        data = file.read_bytes()
        for part in range(8):
            size = len(records.MAGIC) + (len(data) - len(records.MAGIC)) * part // 8 + number % 7
            cut, saved = tmp_path / 'cut.mcap', tmp_path / f'{number}_{part}'
            cut.write_bytes(data[:size])
            with BagWriter(saved) as writer:
                Recovery(writer).save(cut)
            with BagReader(saved) as bag:
                kept = [m.stamp for m in bag.messages()]
                extras = [e for e in bag.files[0].extras() if getattr(e, 'name', '') != 'rosbag2']
                kept += [type(extra).__name__.lower() for extra in extras]
            expected = _whole(data[:size], len(records.MAGIC))
            assert sorted(map(str, kept)) == sorted(map(str, expected)), (file.name, size)
