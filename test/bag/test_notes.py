"""Notes: appended, never in the way of the data, and passed over where they are half."""

from __future__ import annotations

import os

import pytest

from agv_motion.bag import notes as module
from agv_motion.bag.notes import NAME, Note, add_note, carry, notes_of, one_line
from agv_motion.errors import ConfigurationError, SourceError


def test_notes_come_in_the_order_of_their_time_and_on_one_line_each(tmp_path):
    add_note(tmp_path, Note(9, 'late'))
    add_note(tmp_path, Note(5, 'first "line"\nand Grüße'))
    assert notes_of(tmp_path) == [Note(5, 'first "line" and Grüße'), Note(9, 'late')]
    assert (tmp_path / 'notes.jsonl').read_bytes().count(b'\n') == 2
    assert (tmp_path / 'notes.jsonl').stat().st_mode & 0o111 == 0
    for spans, kept in (([(0, 5)], 0), ([(0, 1), (5, 6), (7, 9)], 1), ([(9, 10), (5, 6)], 2)):
        assert carry([tmp_path], tmp_path, spans) == kept


def test_a_file_has_its_notes_beside_it_unless_it_is_part_of_a_bag(tmp_path):
    file = tmp_path / 'walk.mcap'
    add_note(file, Note(1, 'alone'))
    assert [p.name for p in tmp_path.iterdir()] == ['walk.mcap.notes.jsonl']
    (tmp_path / 'metadata.yaml').touch()
    add_note(file, Note(2, 'of the bag'))
    assert notes_of(tmp_path) == notes_of(file) == [Note(2, 'of the bag')]


@pytest.mark.parametrize('size', range(1, 40, 6))
def test_a_note_cut_off_anywhere_costs_only_itself(tmp_path, size):
    add_note(tmp_path, Note(1, 'whole'))
    place = tmp_path / 'notes.jsonl'
    before = place.read_bytes()
    add_note(tmp_path, Note(2, 'half'))
    os.truncate(place, min(len(before) + size, place.stat().st_size - 2))
    assert notes_of(tmp_path) == [Note(1, 'whole')]
    add_note(tmp_path, Note(3, 'after'))
    assert notes_of(tmp_path) == [Note(1, 'whole'), Note(3, 'after')]


def test_a_full_disk_leaves_the_notes_as_they_were(tmp_path, monkeypatch):
    add_note(tmp_path, Note(1, 'whole'))
    written, write = [], os.write

    def full(file, data):
        if written:
            raise OSError(28, 'No space left on device')
        written.append(write(file, data[:7]))
        return 7

    with monkeypatch.context() as disk:
        disk.setattr(module.os, 'write', full)
        with pytest.raises(SourceError, match='No space'):
            add_note(tmp_path, Note(2, 'half'))
    assert notes_of(tmp_path) == [Note(1, 'whole')]
    assert (tmp_path / 'notes.jsonl').read_bytes().endswith(b'}\n')


@pytest.mark.parametrize('line', [
    b'\xff\xfe', b'[]', b'{}', b'{"stamp": "1", "text": "x"}', b'{"stamp": 1.5, "text": "x"}',
    b'{"stamp": -1, "text": "x"}', b'{"stamp": true, "text": "x"}', b'{"stamp": 1, "text": 5}',
    b'{"stamp": 1e400, "text": "x"}', b'[' * 100_000,
    b'{"stamp": 18446744073709551616, "text": ""}',
])  # fmt: skip
def test_what_is_no_note_is_passed_over(tmp_path, line):
    (tmp_path / 'notes.jsonl').write_bytes(line + b'\n{"stamp": 7, "text": "a note"}\n')
    assert notes_of(tmp_path) == [Note(7, 'a note')]


@pytest.mark.parametrize('note', [
    Note(1, ''), Note(1, ' \n'), Note(1, 'x' * 1001), Note(-1, 'x'), Note(2**64, 'x'),
])  # fmt: skip
def test_what_cannot_be_noted_is_refused(tmp_path, note):
    with pytest.raises(ConfigurationError, match='expected'):
        add_note(tmp_path, note)
    assert not notes_of(tmp_path)


def test_notes_are_carried_with_their_time(tmp_path):
    for name, stamps in (('a', (1, 5)), ('b', (5, 9)), ('new', ()), ('part', ())):
        (tmp_path / name).mkdir()
        for stamp in stamps:
            add_note(tmp_path / name, Note(stamp, 'x'))
    bags = tmp_path / 'a', tmp_path / 'b'
    assert carry(bags, tmp_path / 'new', None) == 3
    assert [n.stamp for n in notes_of(tmp_path / 'new')] == [1, 5, 9]
    assert carry(bags, tmp_path / 'part', [(2, 6)]) == 1
    assert carry(bags, tmp_path / 'part', [(6, 9)]) == 0


def test_what_somebody_wrote_becomes_one_line():
    assert one_line(' rain\n\x1b[31m began ') == 'rain [31m began'
    assert one_line('\n') == ''
    assert len(one_line('x' * 5000)) == 1000


def test_no_note_moves_a_cursor_or_turns_the_writing_whoever_wrote_it(tmp_path):
    add_note(tmp_path, Note(1, 'two\n\x1b[2J\u202e\0lines \udcff 👨\u200d🌾'))
    with (tmp_path / NAME).open('a') as file:
        file.write('{"stamp": 2, "text": "a\\u001b[2J\\nb"}\n')
    told = [Note(1, 'two [2J lines 👨\u200d🌾'), Note(2, 'a [2J b')]
    assert notes_of(tmp_path) == told
    with pytest.raises(ConfigurationError, match='a note of 0 characters'):
        add_note(tmp_path, Note(1, '\x1b\0'))
