"""Results of a demo replace those of a demo, and nothing else."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time

import pytest

from agv_motion.bag.metadata import UNFINISHED
from agv_motion.demo.folder import results
from agv_motion.errors import ConfigurationError


def _run(folder, figure='walk.png'):
    """Leave what a run of a demo leaves."""
    with results(folder, figure) as bag:
        bag.mkdir()
        (bag / 'bag_0.mcap').write_text('messages')
        (bag / 'metadata.yaml').write_text('of the bag')
        (folder / figure).write_text('picture')


def test_a_second_run_replaces_the_first(tmp_path):
    _run(tmp_path / 'out')
    with results(tmp_path / 'out', 'walk.png') as bag:
        assert bag == tmp_path / 'out' / 'bag'
        assert not bag.exists()


@pytest.mark.parametrize('name', ['bag/notes.txt', 'bag/run_0.mcap', 'bag/deep/a.mcap', 'walk.png'])
def test_what_nobody_knows_a_demo_wrote_stays_and_is_named(tmp_path, name):
    file = tmp_path / name
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text('seven months')
    with pytest.raises(ConfigurationError, match='was not left by a demo: move it away'):
        _run(tmp_path)
    assert file.read_text() == 'seven months'


@pytest.mark.parametrize(
    'name', ['bag/notes.txt', 'bag/other_0.mcap', 'bag/bag_0.mcap', 'walk.png']
)
def test_what_was_added_or_changed_after_a_run_stays(tmp_path, name):
    _run(tmp_path)
    (tmp_path / name).write_text('mine')
    later = time.time() + 60.0
    os.utime(tmp_path / name, (later, later))
    with pytest.raises(ConfigurationError, match=name):
        _run(tmp_path)
    assert (tmp_path / name).read_text() == 'mine'
    assert (tmp_path / 'bag' / 'bag_0.mcap').exists()


def test_a_bag_that_is_a_link_or_a_file_stays(tmp_path):
    real = tmp_path / 'real'
    real.mkdir()
    (real / 'bag_0.mcap').write_text('mine')
    out = tmp_path / 'out'
    _run(out)
    (out / 'bag').rename(out / 'kept')
    (out / 'bag').symlink_to(real)
    with pytest.raises(ConfigurationError, match='was not left by a demo'):
        _run(out)
    assert (real / 'bag_0.mcap').read_text() == 'mine'


def test_results_of_another_demo_in_the_same_folder_stay(tmp_path):
    _run(tmp_path)
    (tmp_path / 'path.png').write_text('mine')
    with pytest.raises(ConfigurationError, match=r"path\.png' was not left"):
        _run(tmp_path, 'path.png')


def test_what_a_killed_run_left_is_replaced(tmp_path):
    code = f"""
import os, signal
from pathlib import Path
from agv_motion.bag.metadata import UNFINISHED
from agv_motion.demo.folder import results
with results(Path({str(tmp_path)!r}), 'walk.png') as bag:
    bag.mkdir()
    (bag / 'bag_0.mcap').write_text('torn')
    os.kill(os.getpid(), signal.SIGKILL)
"""
    killed = subprocess.run([sys.executable, '-c', code], check=False)  # noqa: S603 - our own
    assert killed.returncode == -signal.SIGKILL
    _run(tmp_path)
    assert (tmp_path / 'bag' / 'bag_0.mcap').read_text() == 'messages'


def test_half_a_description_that_a_killed_run_left_is_the_demos_own(tmp_path):
    _run(tmp_path)
    (tmp_path / 'bag' / UNFINISHED).write_text('half')
    _run(tmp_path)
    assert not (tmp_path / 'bag' / UNFINISHED).exists()


def test_the_marker_is_never_empty(tmp_path, monkeypatch):
    """A run that is killed while it writes the marker leaves the old one, or the new one."""
    seen = []

    def look(descriptor, content, place):
        seen.append((tmp_path / '.agv_demo').read_text())
        return write(descriptor, content, place)

    write = os.pwrite
    _run(tmp_path)
    monkeypatch.setattr(os, 'pwrite', look)
    _run(tmp_path)
    assert len(seen) == 2
    assert all(json.loads(text).keys() == {'bag', 'walk.png'} for text in seen)


def test_two_demos_never_write_to_one_folder(tmp_path):
    with (
        results(tmp_path, 'walk.png'),
        pytest.raises(ConfigurationError, match='another demo is writing'),
        results(tmp_path, 'walk.png'),
    ):
        pass


def test_a_folder_that_cannot_be_is_told(tmp_path):
    (tmp_path / 'file').write_text('')
    with (
        pytest.raises(ConfigurationError, match=r"--output '.*file/out' cannot be written"),
        results(tmp_path / 'file' / 'out', 'walk.png'),
    ):
        pass


def test_a_damaged_marker_vouches_for_nothing(tmp_path):
    _run(tmp_path)
    (tmp_path / '.agv_demo').write_text('[broken')
    with pytest.raises(ConfigurationError, match='was not left by a demo'):
        _run(tmp_path)
