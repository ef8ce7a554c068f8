"""State on disk: whole or not at all, no flipped bit believed, nothing lost, no link followed."""

from __future__ import annotations

import errno
import os
import resource
import signal
from pathlib import Path

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.saved_state import load, restore, save, set_aside


@pytest.fixture
def path(tmp_path):
    return tmp_path / 'state'


def test_it_comes_back_and_leaves_no_other_file(path):
    for content in (b'', b'learnt', bytes(range(256))):
        save(path, content)
        assert load(path) == content
    assert [file.name for file in path.parent.iterdir()] == ['state']


def test_nothing_saved_is_nothing_wrong(path):
    assert load(path) is None
    assert restore(path, pytest.fail) == ''


def test_a_file_without_digest_is_handed_on_as_it_is(path):
    path.write_bytes(b'{"version": 1}')
    assert load(path) == b'{"version": 1}'


def test_every_flipped_bit_and_every_lost_end_is_seen(path):
    save(path, b'the places')
    whole = path.read_bytes()

    def take(content):
        if content != b'the places':
            raise ValueError(content)

    for bit in range(8 * len(whole)):
        damaged = bytearray(whole)
        damaged[bit // 8] ^= 1 << bit % 8
        path.write_bytes(damaged)
        assert 'set aside as state.unusable' in restore(path, take), bit
        (path.parent / 'state.unusable').unlink()
    for end in range(len(whole)):
        path.write_bytes(whole[:end])
        assert 'set aside as state.unusable' in restore(path, take), end
        (path.parent / 'state.unusable').unlink()


def test_nothing_set_aside_is_overwritten(path):
    for i in range(3):
        path.write_text(f'{i}')
        set_aside(path)
    names = ('state.unusable', 'state.unusable.2', 'state.unusable.3')
    assert [(path.parent / name).read_text() for name in names] == ['0', '1', '2']
    assert not path.exists()


def test_what_cannot_be_set_aside_is_told(path, monkeypatch):
    path.write_text('damaged')

    def no_place(*_):
        raise OSError(errno.EROFS, 'read-only')

    monkeypatch.setattr(os, 'open', no_place)
    assert set_aside(path) == 'it could not be set aside (read-only)'
    assert path.read_text() == 'damaged'


def test_a_file_too_large_is_not_read(path):
    with path.open('wb') as file:
        file.truncate(1 << 40)
    assert 'set aside' in restore(path, pytest.fail)


def test_what_its_reader_cannot_use_is_set_aside(path):
    save(path, b'deep')

    def take(_):
        raise RecursionError

    assert 'set aside' in restore(path, take)
    assert not path.exists()


def test_no_place_for_a_file_is_a_mistake_of_the_configuration(tmp_path):
    (tmp_path / 'link').symlink_to(tmp_path / 'none')
    os.mkfifo(tmp_path / 'pipe')
    for place, word in (
        (tmp_path, 'is a folder'),
        (tmp_path / 'link', 'is a symbolic link'),
        (tmp_path / 'pipe', 'is no regular file'),
        (Path('/dev/zero'), 'is no regular file'),
        (tmp_path / ('x' * 300), 'is no path'),
        ('a\0b', 'is no path'),
    ):
        with pytest.raises(ConfigurationError, match=word):
            restore(place, pytest.fail)
    assert sorted(file.name for file in tmp_path.iterdir()) == ['link', 'pipe']


def test_a_pipe_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / 'pipe')
    with pytest.raises(ConfigurationError, match='no regular file'):
        load(tmp_path / 'pipe')


def test_saving_writes_through_no_link(path, tmp_path):
    victim = tmp_path / 'victim'
    victim.write_text('untouched')
    path.symlink_to(victim)
    save(path, b'state')
    assert victim.read_text() == 'untouched'
    assert not path.is_symlink()
    assert load(path) == b'state'


def test_the_name_of_the_unfinished_file_cannot_be_foretold(path, monkeypatch):
    """Whoever lays a file or link under the name seen last, or a guessed one, is not written to."""
    names, replace = [], Path.replace

    def seen(self, target):
        names.append(self.name)
        return replace(self, target)

    monkeypatch.setattr(Path, 'replace', seen)
    save(path, b'1')
    save(path, b'2')
    assert len(set(names)) == 2
    assert not any('new' in name or path.name + '.' in name for name in names)


def test_what_a_killed_save_left_is_swept_and_what_is_being_written_is_not(path):
    save(path, b'1')
    old, new, mine = (path.with_name(f'.state-{word}') for word in ('a' * 32, 'b' * 32, 'notes'))
    for file in (old, new, mine):
        file.write_bytes(b'half')
    for file in (old, mine):
        os.utime(file, (1e9, 1e9))
    save(path, b'2')
    assert {file.name for file in path.parent.iterdir()} == {path.name, new.name, mine.name}


def test_permissions_stay_and_new_ones_follow_the_umask(path):
    before = os.umask(0o027)
    try:
        save(path, b'1')
        assert path.stat().st_mode & 0o777 == 0o640
        path.chmod(0o604)
        save(path, b'2')
        assert path.stat().st_mode & 0o777 == 0o604
    finally:
        os.umask(before)


@pytest.mark.parametrize('call', ['fsync', 'fchmod', 'open'])
def test_a_save_cut_short_leaves_the_old_file_alone(path, monkeypatch, call):
    save(path, b'old')

    def cut(*_):
        raise OSError(errno.EIO, 'cut')

    with monkeypatch.context() as patch:
        patch.setattr(os, call, cut)
        with pytest.raises(OSError, match='cut'):
            save(path, b'new')
    assert load(path) == b'old'
    assert [file.name for file in path.parent.iterdir()] == ['state']


def test_a_full_disk_is_told_and_leaves_the_old_file_alone(path):
    """The process may write no file beyond 1,000 bytes: the disk's own error, without a disk."""
    save(path, b'old')
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, limits[1]))
    try:
        with pytest.raises(OSError, match='too large'):
            save(path, bytes(100_000))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, handler)
    assert load(path) == b'old'
    assert [file.name for file in path.parent.iterdir()] == ['state']
