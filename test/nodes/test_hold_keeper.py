"""What holds at the arbiter outlasts a restart, or that is told."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from agv_motion.arbitration.choice import FREE, Hold
from agv_motion.arbitration.source import TwistSource
from agv_motion.nodes.hold_keeper import HoldKeeper

LOCKED = FREE._replace(locks=frozenset({TwistSource.AGENT}))


@pytest.fixture
def port():
    told = []
    return SimpleNamespace(told=told, seconds=lambda: 7.0, error=told.append, refuse=told.append)


def test_what_is_kept_is_there_after_a_restart(port, tmp_path):
    path = str(tmp_path / 'hold')
    HoldKeeper(port, path).keep(LOCKED)
    assert HoldKeeper(port, path).before().locks == LOCKED.locks
    assert port.told == []


def test_without_a_path_nothing_is_kept_nor_missed(port):
    keeper = HoldKeeper(port, '')
    keeper.keep(LOCKED)
    assert (keeper.before(), keeper.trouble, port.told) == (FREE, '', [])


def test_a_file_that_nobody_can_read_is_a_stop(port, tmp_path):
    (tmp_path / 'hold').write_text('{')
    found = HoldKeeper(port, str(tmp_path / 'hold')).before()
    assert isinstance(found, Hold)
    assert found.stop is not None
    assert 'STOP holds; look at the robot' in port.told[0]


def test_a_disk_that_takes_nothing_is_told_and_tried_again(port, tmp_path):
    folder = tmp_path / 'missing'
    keeper = HoldKeeper(port, str(folder / 'hold'))
    (tmp_path / 'missing').write_text('a file where a folder should be')
    keeper.keep(LOCKED)
    assert keeper.trouble == (
        f'cannot keep STOP and locks over a restart in {folder / "hold"} (File exists): see '
        'that it can be written, or give another file'
    )
    folder.unlink()
    folder.mkdir()
    keeper.keep(LOCKED)
    assert keeper.trouble == ''
    assert len(port.told) == 1
