"""A database is looked at without touching its folder, with what lies beside it."""

from __future__ import annotations

import shutil
import sqlite3
from contextlib import closing
from types import SimpleNamespace

import pytest

from agv_motion.bag.sqlite.aside import set_aside
from agv_motion.errors import SourceError


def numbers(path):
    with closing(sqlite3.connect(path)) as database:
        return [number for (number,) in database.execute('select n from t order by n')]


@pytest.fixture
def killed(tmp_path):
    """Return a database whose writer was killed: its last row is in the log alone."""
    live, dead = tmp_path / 'live.db3', tmp_path / 'dead' / 'bag.db3'
    dead.parent.mkdir()
    with closing(sqlite3.connect(live, isolation_level=None)) as database:
        database.execute('pragma journal_mode = wal')
        database.execute('create table t (n)')
        database.execute('pragma wal_checkpoint(truncate)')
        database.execute('insert into t values (1)')
        shutil.copyfile(live, dead)
        shutil.copyfile(f'{live}-wal', f'{dead}-wal')
    return dead


def test_a_file_alone_is_linked(tmp_path):
    bag = tmp_path / 'bag.db3'
    with closing(sqlite3.connect(bag)) as database, database:
        database.execute('create table t (n)')
    (tmp_path / 'aside').mkdir()
    aside = set_aside(bag, tmp_path / 'aside')
    assert (aside.is_symlink(), aside.resolve(), numbers(aside)) == (True, bag, [])


def test_rows_of_the_log_are_there_and_the_folder_stays_as_it_is(tmp_path, killed):
    before = {path.name: path.read_bytes() for path in killed.parent.iterdir()}
    (tmp_path / 'aside').mkdir()
    aside = set_aside(killed, tmp_path / 'aside')
    assert numbers(aside) == [1]
    assert [path.name for path in aside.parent.iterdir()] == ['aside.db3']
    assert {path.name: path.read_bytes() for path in killed.parent.iterdir()} == before


def test_a_disk_without_room_is_told_with_its_need(tmp_path, killed, monkeypatch):
    size = sum(path.stat().st_size for path in killed.parent.iterdir())
    monkeypatch.setattr(shutil, 'disk_usage', lambda _: SimpleNamespace(free=2 * size - 1))
    with pytest.raises(SourceError, match=f'need {2 * size} bytes in .*: set TMPDIR to a larger'):
        set_aside(killed, tmp_path)
