"""The memory on disk: comes back, and a file that is none is set aside, never fatal."""

from __future__ import annotations

import os
import re
import struct
import tracemalloc
import zipfile
from io import BytesIO

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.motion.behavior.memory import Memory
from agv_motion.motion.behavior.memory_file import restore, save
from agv_motion.motion.navigation.zone import Zone

ZONE = Zone([[0, 0], [4, 0], [4, 4], [0, 4]])


def full():
    memory = Memory(ZONE)
    memory.update(1.4e9, 1.0, 1.0, 0.75)
    return memory


def test_it_comes_back(tmp_path):
    path, again = tmp_path / 'new' / 'memory.npz', Memory(ZONE)
    save(path, full().grid())
    assert restore(path, again) == ''
    assert again.flow[4, 4] == 0.75
    assert [file.name for file in path.parent.iterdir()] == ['memory.npz']


def test_a_zone_goes_by_sixteen_digits_in_every_file():
    """Files that are on the disks of robots have them: with others a tree would begin anew."""
    assert re.fullmatch('[0-9a-f]{16}', full().grid().zone)


def test_nothing_kept_is_nothing_wrong(tmp_path):
    assert restore(tmp_path / 'none', Memory(ZONE)) == ''


def test_a_save_cut_short_leaves_the_old_one(tmp_path, monkeypatch):
    path, again = tmp_path / 'memory.npz', Memory(ZONE)
    save(path, full().grid())

    def power_cut(*_):
        raise OSError

    monkeypatch.setattr(os, 'fsync', power_cut)
    with pytest.raises(OSError):  # noqa: PT011 - the one above
        save(path, Memory(ZONE).grid())
    assert restore(path, again) == ''
    assert again.flow[4, 4] == 0.75


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60)
@given(st.data())
def test_any_damage_is_noticed_or_harmless(tmp_path, data):
    """A flipped byte or a lost end: the file is set aside, or what it says is unchanged."""
    path, again = tmp_path / 'memory.npz', Memory(ZONE)
    save(path, full().grid())
    content = bytearray(path.read_bytes())
    place = data.draw(st.integers(0, len(content) - 1))
    if data.draw(st.booleans()):
        content[place] ^= data.draw(st.integers(1, 255))
    else:
        del content[place:]
    path.write_bytes(content)
    complaint = restore(path, again)
    if complaint:
        assert 'set aside as memory.npz.unusable' in complaint
        assert not path.exists()
        assert not again.felt.any()
    else:
        assert np.array_equal(again.flow, full().flow, equal_nan=True)


def in_the_old_format(path):
    """Write a file as it was written before the digest."""
    np.savez_compressed(path, version=1, **full().grid()._asdict())
    return path


def test_a_file_of_the_time_before_digests_is_taken_up(tmp_path):
    again = Memory(ZONE)
    assert restore(in_the_old_format(tmp_path / 'memory.npz'), again) == ''
    assert np.array_equal(again.flow, full().flow, equal_nan=True)


@pytest.mark.parametrize('old', [False, True], ids=['new', 'old'])
def test_no_flipped_bit_stops_the_start(tmp_path, old):
    """One bit of each third byte, of a new file of all at its head; with a digest, each is seen."""
    path, memory = tmp_path / 'memory.npz', Memory(ZONE)
    if old:
        in_the_old_format(path)
    else:
        save(path, full().grid())
    content = bytearray(path.read_bytes())
    for place in sorted({*range(0 if old else 200), *range(0, len(content), 3)}):
        content[place] ^= 1 << place % 8
        path.write_bytes(content)
        complaint = restore(path, memory)
        content[place] ^= 1 << place % 8
        if complaint or not old:
            assert 'set aside as memory.npz.unusable' in complaint, place
            (tmp_path / 'memory.npz.unusable').unlink()


def bomb(path, shape, packed, **change):
    """Write an archive whose member `flow` says it has ``shape`` and holds ``packed``."""
    in_the_old_format(path)
    with zipfile.ZipFile(path) as whole:
        members = {name: whole.read(name) for name in whole.namelist()}
    head = BytesIO()
    np.lib.format.write_array_header_1_0(
        head, {'descr': '<f8', 'fortran_order': False, 'shape': shape, **change}
    )
    members['flow.npy'] = head.getvalue() + packed
    with zipfile.ZipFile(path, 'w', zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(name, content)


@pytest.mark.parametrize(
    ('shape', 'packed', 'change', 'word'),
    [
        ((10**6, 10**6), bytes(64), {}, 'is said to hold'),
        ((2**62, 4), b'', {}, 'is said to hold'),
        ((0, 10**12), b'', {}, 'shapes'),
        ((16, 16), bytes(4 * 10**7), {}, 'would unpack to 40000'),
        ((16, 16), bytes(2048), {'descr': '|O'}, 'is said to hold'),
        ((16, 16), bytes(2048), {'fortran_order': True}, 'is said to hold'),
    ],
)
def test_sizes_are_checked_before_anything_is_allocated(tmp_path, shape, packed, change, word):
    path = tmp_path / 'memory.npz'
    bomb(path, shape, packed, **change)
    tracemalloc.start()
    try:
        complaint = restore(path, Memory(ZONE))
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert word in complaint
    assert peak < 2e6


def test_an_archive_that_lies_about_its_size_is_not_unpacked(tmp_path):
    """Said to unpack to 2 kB, packed from 30 MB."""
    path = tmp_path / 'memory.npz'
    bomb(path, (16, 16), bytes(30_000_000))
    with zipfile.ZipFile(path) as archive:
        size = archive.getinfo('flow.npy').file_size
    content = path.read_bytes()
    path.write_bytes(content.replace(struct.pack('<I', size), struct.pack('<I', 2176)))
    tracemalloc.start()
    try:
        complaint = restore(path, Memory(ZONE))
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert 'set aside' in complaint
    assert peak < 2e6


@pytest.mark.parametrize(
    ('change', 'word'),
    [
        ({'version': 9}, 'no memory of version'),
        ({'flow': np.full((16, 16), 2.0)}, 'outside'),
        ({'flow': np.zeros((3, 3))}, 'shapes'),
        ({'felt_at': np.full((16, 16), np.nan)}, 'times'),
        ({'visited_at': np.full((16, 16), np.inf)}, 'times'),
        ({'cell': 0.0}, 'cells of 0.0 m'),
        ({'west': np.nan}, 'nan'),
        ({'flow': 'words'}, 'cannot be used'),
    ],
)
def test_values_that_no_memory_holds_are_not_believed(tmp_path, change, word):
    path, again = tmp_path / 'memory.npz', Memory(ZONE)
    np.savez(path, **({'version': 1, **full().grid()._asdict()} | change))
    assert word in restore(path, again)
    assert not again.visited.any()


def test_another_zone_is_told_and_its_file_kept(tmp_path):
    path = tmp_path / 'memory.npz'
    save(path, full().grid())
    again = Memory(Zone([[0, 0], [4, 0], [4, 3], [0, 3]]))
    complaint = restore(path, again)
    assert 'belongs to another zone' in complaint
    assert 'carried over; set aside as memory.npz.other_zone' in complaint
    assert again.flow[4, 4] == 0.75


def test_a_folder_is_refused(tmp_path):
    with pytest.raises(ConfigurationError, match='is a folder'):
        restore(tmp_path, Memory(ZONE))
