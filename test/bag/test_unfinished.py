"""A folder takes its place when it is whole, and not before."""

from __future__ import annotations

import pytest

from agv_motion.bag.unfinished import beside, sweep
from agv_motion.errors import SourceError


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
