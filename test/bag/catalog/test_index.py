"""The index of a folder: what is read once, read again, forgotten, and made anew."""

from __future__ import annotations

import os
import shutil
import sqlite3
import sys
from contextlib import closing
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[1] / 'editing'))

import bags

from agv_motion.bag.catalog import index as catalog
from agv_motion.bag.catalog.discovery import bags_below
from agv_motion.bag.catalog.entry import BagEntry, TopicEntry, entry_of
from agv_motion.bag.catalog.find import Question, find
from agv_motion.bag.catalog.index import NAME, BagIndex
from agv_motion.bag.catalog.statistics import topic_amounts
from agv_motion.errors import SourceError

DAY = 86400
SECOND = 10**9
MAY = 1_714_521_600
"""[s] 2024-05-01"""


def updated(folder, tell=lambda *_: None):
    with BagIndex(folder) as index:
        return index.update(tell)


def names(folder, **asked):
    with BagIndex(folder) as index:
        index.update()
        return [str(one.path.relative_to(index.folder)) for one in find(index, Question(**asked))]


def test_only_what_is_new_or_has_changed_is_read(season):
    steps = []
    first = updated(season, lambda *step: steps.append(step))
    assert (first.bags, first.read, first.gone, first.damaged) == (4, 4, 0, 1)
    assert steps == [(0, 4), (1, 4), (2, 4), (3, 4), (4, 4)]
    assert updated(season) == (4, 0, 0, 1)
    shutil.rmtree(season / 'b')
    bags.write(season / 'd', start=MAY + 300)
    file = season / 'c' / 'c_0.mcap'
    os.utime(file, ns=(1, 1))
    assert updated(season) == (4, 2, 1, 1)
    assert names(season) == ['north/a', 'd', 'c', 'loose.mcap']


def test_it_is_one_hidden_file_in_the_folder_that_no_command_takes_for_a_bag(season):
    before = set(season.rglob('*'))
    updated(season)
    assert set(season.rglob('*')) - before == {season / NAME}
    assert (season / NAME).resolve() not in bags_below(season)


@pytest.mark.parametrize('spoil', ['nonsense', 'another version', 'torn'])
def test_an_index_that_is_none_is_made_anew(season, spoil):
    updated(season)
    if spoil == 'nonsense':
        (season / NAME).write_bytes(b'no database at all' * 100)
    elif spoil == 'torn':
        os.truncate(season / NAME, 5000)
    else:
        with sqlite3.connect(season / NAME) as database:
            database.execute('PRAGMA user_version = 99')
    assert updated(season) == (4, 4, 0, 1)


def test_an_index_with_other_kinds_of_values_is_made_anew(season):
    """A disk that has changed a byte could leave that; SQLite itself refuses to write it."""
    updated(season)
    refusal = pytest.raises(sqlite3.IntegrityError, match='cannot store TEXT value')
    with sqlite3.connect(season / NAME) as database, refusal:
        database.execute("UPDATE topic SET messages = 'many'")
    loose = 'UPDATE sqlite_master SET sql = replace(sql, ?, ?)'
    for change, words in (
        ('UPDATE sqlite_master SET rootpage = rootpage', ('STRICT', '')),
        ("UPDATE topic SET messages = 'many'", (', size REAL)', ', size REAL) STRICT')),
    ):
        with closing(sqlite3.connect(season / NAME, isolation_level=None)) as database:
            database.execute('PRAGMA writable_schema = ON')
            database.execute(change)
            database.execute(loose, words)
    assert updated(season) == (4, 4, 0, 1)


def test_a_bag_that_tells_of_more_messages_than_a_disk_holds_is_indexed(season, monkeypatch):
    hostile = BagEntry(0, 1, 2**64 - 1, 10, '', (TopicEntry('/a', 'a/msg/A', 2**64 - 1, None),))
    monkeypatch.setattr(catalog, 'entry_of', lambda _: hostile)
    with BagIndex(season) as index:
        index.update()
        assert topic_amounts(index, Question())[0].messages == 4 * catalog.MOST_MESSAGES


def test_where_nothing_can_be_written_it_is_in_the_cache(season, tmp_path, monkeypatch):
    monkeypatch.setenv('XDG_CACHE_HOME', str(tmp_path / 'cache'))
    (season / NAME).mkdir()
    with BagIndex(season) as index:
        assert index.path.parent == tmp_path / 'cache' / 'agv_motion'
        assert index.update().bags == 4
    assert updated(season).read == 0
    monkeypatch.setenv('XDG_CACHE_HOME', str(season / 'loose.mcap'))
    with pytest.raises(SourceError, match='XDG_CACHE_HOME'):
        BagIndex(season)


def test_a_file_is_no_folder_of_bags(season):
    with pytest.raises(SourceError, match='is no folder'):
        BagIndex(season / 'loose.mcap')


def test_work_that_is_killed_goes_on_where_it_was(season, monkeypatch):
    monkeypatch.setattr(catalog, 'TOGETHER', 1)
    with BagIndex(season) as index:

        def die(done, _):
            if done == 2:
                raise KeyboardInterrupt

        with pytest.raises(KeyboardInterrupt):
            index.update(die)
    assert updated(season).read == 2


def test_bags_may_be_read_in_any_order_and_what_is_left_out_is_read_later(season):
    def read(paths):
        assert len(paths) == 4
        yield from ((path, entry_of(path)) for path in reversed(paths[1:]))

    with BagIndex(season) as index:
        index.update(read=read)
    assert updated(season) == (4, 1, 0, 1)


def test_two_that_make_an_index_anew_at_once_do_not_disturb_each_other(season, monkeypatch):
    (season / NAME).write_bytes(b'no database at all' * 100)
    unlink = Path.unlink

    def after_another(path, *, missing_ok=False):
        unlink(path)
        unlink(path, missing_ok=missing_ok)

    monkeypatch.setattr(Path, 'unlink', after_another)
    with BagIndex(season) as index:
        assert index.path == season / NAME


def test_names_that_are_no_text_are_names(season):
    (season / 'c').rename(season / os.fsdecode(b'c\xff'))
    assert len(names(season, begin='2024-06')) == 2
