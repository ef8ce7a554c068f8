"""A folder, or a file, takes its place when it is whole, and not before."""

from __future__ import annotations

import os
import stat
import threading
from pathlib import Path

import pytest

from agv_motion.errors import SourceError
from agv_motion.files.unfinished import beside, replacing, sweep


def test_a_folder_appears_whole_at_the_end(tmp_path):
    target = tmp_path / 'deep' / 'bag'
    with beside(target) as made:
        made.mkdir()
        (made / 'one').write_text('1')
        assert not target.exists()
        assert made.name == 'bag'
        (made / 'two').write_text('2')
    assert sorted(p.name for p in target.iterdir()) == ['one', 'two']
    assert list(target.parent.iterdir()) == [target]


def test_an_error_leaves_nothing(tmp_path):
    def end_half_way():
        with beside(tmp_path / 'bag') as made:
            made.mkdir()
            (made / 'half').write_text('1')
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        end_half_way()
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize('how', ['file', 'folder', 'link'])
def test_nothing_is_written_over(tmp_path, how):
    target = tmp_path / 'bag'
    {'file': target.touch, 'folder': target.mkdir, 'link': lambda: target.symlink_to('/none')}[
        how
    ]()
    with pytest.raises(SourceError, match='File exists'), beside(target):
        pass
    target.unlink() if how != 'folder' else target.rmdir()

    def be_late():
        with beside(target) as made:
            made.mkdir()
            target.mkdir()  # somebody else, meanwhile

    with pytest.raises(SourceError, match='File exists'):
        be_late()
    assert list(tmp_path.iterdir()) == [target]
    assert not list(target.iterdir())


def test_what_a_killed_writer_left_is_swept_and_what_is_in_use_is_not(tmp_path):
    left = tmp_path / '.bag.unfinished-0123'
    (left / 'bag').mkdir(parents=True)
    (tmp_path / '.other.unfinished-0123').mkdir()
    with beside(tmp_path / 'bag') as made:
        made.mkdir()
        assert not left.exists()
        sweep(tmp_path / 'bag')
        assert made.exists()
    assert {p.name for p in tmp_path.iterdir()} == {'bag', '.other.unfinished-0123'}


@pytest.mark.parametrize('before', ['old', None])
def test_a_file_is_replaced_whole_or_not_at_all(tmp_path, before):
    path = tmp_path / 'a.yaml'
    if before is not None:
        path.write_text(before)
        path.chmod(0o640)

    def end_half_way():
        with replacing(path) as made:
            made.write_text('half')
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        end_half_way()
    assert [p.read_text() for p in tmp_path.iterdir()] == [before] * (before is not None)
    with replacing(path) as made:
        assert made.name == path.name
        made.write_text('new')
        assert path.exists() == (before is not None)
    assert [(p.name, p.read_text()) for p in tmp_path.iterdir()] == [('a.yaml', 'new')]
    if before is not None:
        assert stat.S_IMODE(path.stat().st_mode) == 0o640


def test_the_file_behind_a_link_is_replaced_and_the_link_stays(tmp_path):
    (tmp_path / 'deep').mkdir()
    real, link = tmp_path / 'deep' / 'real', tmp_path / 'link'
    real.write_text('old')
    link.symlink_to(real)
    with replacing(link) as made:
        made.write_text('new')
    assert link.is_symlink()
    assert real.read_text() == 'new'
    assert not list(tmp_path.glob('.*'))


def test_a_pipe_is_written_to_and_stays(tmp_path):
    pipe = tmp_path / 'pipe'
    os.mkfifo(pipe)
    heard = []
    reader = threading.Thread(target=lambda: heard.append(pipe.read_text()))
    reader.start()
    with replacing(pipe) as made:
        made.write_text('new')
    reader.join(60.0)
    assert heard == ['new']
    assert pipe.is_fifo()


def test_a_place_that_takes_nothing_is_told(tmp_path):
    for path in (tmp_path / 'none' / 'a', tmp_path):
        with (
            pytest.raises(SourceError, match=r'cannot be written .* choose another place'),
            replacing(path) as made,
        ):
            made.write_text('new')
    assert not list(tmp_path.iterdir())


def test_the_disk_has_everything_before_it_takes_its_place(tmp_path, monkeypatch):
    """Or a power cut could leave the new name with nothing behind it."""
    order = []
    sync, rename = os.fsync, Path.rename

    def noted_sync(descriptor):
        order.append(Path(f'/proc/self/fd/{descriptor}').readlink().name)
        sync(descriptor)

    def noted_rename(path, target):
        order.append('renamed')
        return rename(path, target)

    monkeypatch.setattr(os, 'fsync', noted_sync)
    monkeypatch.setattr(Path, 'rename', noted_rename)
    with beside(tmp_path / 'bag') as made:
        (made / 'inner').mkdir(parents=True)
        (made / 'a').write_text('a')
        (made / 'inner' / 'b').write_text('b')
    assert order.index('renamed') == len(order) - 2
    assert set(order[:-2]) == {'a', 'b', 'inner', 'bag'}
    assert order[-1] == tmp_path.name
    order.clear()
    with replacing(tmp_path / 'note') as made:
        made.write_text('x')
    assert order == ['note', tmp_path.name]
