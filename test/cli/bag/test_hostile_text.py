"""A bag whose every text wants to command the terminal, through every command that tells of it."""

from __future__ import annotations

import csv
import io
import json
import os
import pty
import re
import struct
import sys
from contextlib import suppress

import pytest

from agv_motion.bag import BagReader, BagWriter
from agv_motion.bag.editing.edit import Edit, edit
from agv_motion.bag.mcap.records import Metadata
from agv_motion.bag.notes import Note, add_note
from agv_motion.cli import main
from agv_motion.visible import visible

pytest.importorskip('rclpy')

EVIL = 'x\x1b]0;mine\x07\x1b[2J\x9b5n\x7f\r\u202e[/b]\nFAKE: all is well\t'
TOPIC = f'/a{EVIL}'
OBEYED = re.compile('[\0-\x08\x0b-\x1f\x7f-\x9f\u2028-\u202e]')
SECOND = 10**9


def text(words):
    return b'\0\1\0\0' + struct.pack('<I', len(words.encode()) + 1) + words.encode() + b'\0'


def write(folder, kind, count=4):
    with BagWriter(folder, chunk_size=100) as bag:
        topic = bag.add_topic(TOPIC, kind, 'string data\n', type_hash=EVIL)
        bag.add_topic('/unknown', f'a/msg/A{EVIL}', EVIL, type_hash=EVIL)
        number = bag.add_topic(f'{TOPIC}2', 'a/msg/B', 'float64 data\n', type_hash='')
        for i in range(count):
            bag.write(topic, (100 + i) * SECOND, text(EVIL))
            bag.write(number, (100 + i) * SECOND, b'\0\1\0\0' + struct.pack('<d', i + count))
    add_note(folder, Note(101 * SECOND, EVIL))
    return folder


@pytest.fixture(scope='module')
def evil(tmp_path_factory):
    """Return a folder with two such bags."""
    folder = tmp_path_factory.mktemp('season')
    write(folder / 'one', 'a/msg/A')
    write(folder / 'two', 'b/msg/A', 5)
    with BagReader(folder / 'one') as bag:
        edit([bag], folder / 'held', Edit(record=Metadata(EVIL, {EVIL: EVIL, 'k': EVIL})))
    add_note(folder / 'held', Note(101 * SECOND, EVIL))
    return folder


@pytest.fixture
def agv(monkeypatch, tmp_path):
    """Return what runs the command in this process, and returns its status and all it wrote."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(main, 'interrupt', lambda: None)

    def run(*words):
        streams = [io.TextIOWrapper(io.BytesIO(), encoding='utf-8') for _ in range(2)]
        for name, stream in zip(('stdout', 'stderr'), streams, strict=True):
            monkeypatch.setattr(sys, name, stream)
        monkeypatch.setattr(sys, 'argv', ['agv', *map(str, words)])
        with pytest.raises(SystemExit) as end:
            main.main()
        for stream in streams:
            stream.flush()
        return end.value.code, *(stream.buffer.getvalue().decode() for stream in streams)

    return run


COMMANDS = {
    ('info', 'ONE', '-v'): 0, ('info', 'ONE', '-t'): 0, ('check', 'ONE'): 1, ('du', 'ONE'): 0,
    ('echo', 'ONE', '/unknown'): 1, ('hz', 'ONE'): 0, ('list', 'HELD'): 0,
    ('gaps', 'ONE', f'{TOPIC}2'): 0,
    ('hz', 'ONE', TOPIC, '--header'): 1, ('echo', 'ONE', TOPIC): 0, ('echo', 'ONE', '/b'): 1,
    ('echo', 'ONE', f'{TOPIC}2', '--filter', 'm.nothing'): 1, ('diff', 'ONE', 'TWO'): 1,
    ('diff', 'ONE', 'TWO', '--by-place'): 1, ('index', 'FOLDER'): 0,
    ('find', 'FOLDER', '--topic', TOPIC): 1, ('find', 'FOLDER', '--where', f'{TOPIC}2 > 1'): 1,
    ('find', 'FOLDER', '--json'): 0, ('stats', 'FOLDER'): 0, ('stats', 'FOLDER', '--json'): 0,
    ('cut', 'ONE', 'NEW', '--around', f'{TOPIC}2/data > 4'): 1, ('recover', 'ONE', 'NEW'): 0,
    ('filter', 'ONE', 'NEW', '--topics', '/b'): 1, ('merge', 'ONE', 'TWO', 'NEW'): 0,
    ('convert', 'ONE', 'NEW', '--to', 'sqlite3'): 0, ('export', 'ONE', 'NEW'): 1,
    ('export', 'ONE', 'NEW', '--topics', '/b'): 1, ('errors', 'ONE', '--reference', TOPIC): 1,
    ('plot', 'ONE', TOPIC): 1, ('note', 'ONE', EVIL, '--at', EVIL): 1,
}  # fmt: skip


@pytest.mark.parametrize('words', COMMANDS, ids=lambda words: f'{words[0]} {len(str(words))}')
def test_a_terminal_finds_nothing_to_obey_and_no_line_that_is_not_ours(evil, agv, tmp_path, words):
    places = {'FOLDER': evil, 'NEW': tmp_path / 'new'}
    places |= {name: evil / name.lower() for name in ('ONE', 'TWO', 'HELD')}
    status, *streams = agv('bag', *(places.get(word, word) for word in words))
    assert status == COMMANDS[words], streams
    for told in streams:
        assert not OBEYED.search(told)
        assert not re.search('^FAKE', told, re.MULTILINE), told


def test_nothing_is_lost_in_a_pipe(evil, agv):
    status, out, _ = agv('bag', 'info', evil / 'one', '-t')
    shown = 'x\\x1b]0;mine\\x07\\x1b[2J\\u009b5n\\u007f\\x0d\\u202e[/b]\\x0aFAKE: all is well\\x09'
    assert (status, out) == (0, f'/a{shown}\n/a{shown}2\n/unknown\n')
    status, out, _ = agv('bag', 'echo', evil / 'one', TOPIC, '--csv', '--once')
    assert [row[0] for row in csv.reader(io.StringIO(out, newline=''))] == [visible(EVIL)]


def test_json_is_exact(evil, agv):
    told = json.loads(agv('bag', 'stats', evil, '--json')[1])
    assert TOPIC in [one[0] if isinstance(one, list) else one['name'] for one in told['topics']]


def test_a_terminal_that_watches_sees_only_our_colours(evil, alone):
    master, slave = pty.openpty()
    process = alone.start('bag', 'check', evil / 'one', stdin=slave, stdout=slave, stderr=slave)
    os.close(slave)
    seen = b''
    with suppress(OSError):  # the end of a terminal is an error
        while piece := os.read(master, 1 << 16):
            seen += piece
    os.close(master)
    assert process.wait(120) == 1
    assert b'1 errors and' in seen
    assert set(re.findall(rb'\x1b.[^a-zA-Z]*[a-zA-Z]|[\x07\x7f]|\xc2\x9b', seen)) <= {
        b'\x1b[?25l', b'\x1b[?25h', b'\x1b[32m', b'\x1b[0m', b'\x1b[2K', b'\x1b[1A',
    }  # fmt: skip
