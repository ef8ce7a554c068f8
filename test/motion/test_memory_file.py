"""The memory on disk: comes back, and a file that is none is set aside, never fatal."""

from __future__ import annotations

import os

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.motion.memory import Memory
from agv_motion.motion.memory_file import restore, save
from agv_motion.motion.zone import Zone

ZONE = Zone([[0, 0], [4, 0], [4, 4], [0, 4]])


def full():
    memory = Memory(ZONE)
    memory.feel(1.4e9, 1.0, 1.0, 0.75)
    return memory


def test_it_comes_back(tmp_path):
    path, again = tmp_path / 'new' / 'memory.npz', Memory(ZONE)
    save(path, full().grid())
    assert restore(path, again) == ''
    assert again.flow[4, 4] == 0.75
    assert [file.name for file in path.parent.iterdir()] == ['memory.npz']


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
