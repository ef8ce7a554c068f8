"""A result knows what it was made of."""

from __future__ import annotations

import os

import pytest

from agv_motion.reprocess.provenance import fingerprint, is_made, note


@pytest.fixture
def bag(tmp_path):
    folder = tmp_path / 'bag'
    folder.mkdir()
    (folder / 'a.mcap').write_bytes(b'1234')
    os.utime(folder / 'a.mcap', ns=(5, 5))
    return folder


def test_the_same_has_the_same_fingerprint_wherever_it_lies(bag, tmp_path):
    before = fingerprint(bag, ('nodes', 7))
    assert len(before) == 64
    assert fingerprint(bag.rename(tmp_path / 'moved'), ('nodes', 7)) == before


def test_another_file_size_time_or_parameter_has_another(bag):
    found = {fingerprint(bag, 7), fingerprint(bag, 8)}
    os.utime(bag / 'a.mcap', ns=(5, 6))
    found.add(fingerprint(bag, 7))
    (bag / 'a.mcap').write_bytes(b'12345')
    os.utime(bag / 'a.mcap', ns=(5, 5))
    found.add(fingerprint(bag, 7))
    (bag / 'b.mcap').write_bytes(b'')
    found.add(fingerprint(bag, 7))
    assert len(found) == 5


def test_only_a_whole_note_with_the_same_fingerprint_counts(bag, tmp_path):
    assert not is_made(tmp_path, 'abc')
    note(tmp_path, bag, 'abc')
    assert is_made(tmp_path, 'abc')
    assert not is_made(tmp_path, 'abd')
    for spoilt in ('{"fingerprint": ', '["abc"]', ''):
        (tmp_path / 'reprocessed.json').write_text(spoilt)
        assert not is_made(tmp_path, 'abc')
