"""MCAP to sqlite3 and back, judged by rosbags."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest
from rosbags.rosbag2 import Reader

from agv_motion.bag import BagReader, BagWriter, OfferedQos
from agv_motion.bag.editing.edited_bags import EditReport
from agv_motion.bag.editing.request import EditRequest
from agv_motion.bag.selection import Selection
from agv_motion.errors import ConfigurationError, SignalError, SourceError

_SPEC = importlib.util.spec_from_file_location('bags', Path(__file__).with_name('bags.py'))
bags = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(bags)


def without_sending(messages):
    return [(topic, stamp, data) for topic, stamp, _, _, data in messages]


def test_there_and_back_nothing_is_lost_but_times_of_sending(tmp_path):
    walk, there, back = bags.write(tmp_path / 'walk'), tmp_path / 'there', tmp_path / 'back'
    outcome = EditRequest(storage='').make([walk], there)
    assert outcome.report == EditReport(41, 0, 0, 1)
    with Reader(there) as bag:  # an independent reader, of sqlite3
        found = [(c.topic, stamp, data) for c, stamp, data in bag.messages()]
        assert {c.topic: c.msgcount for c in bag.connections}['/map'] == 1
        latched = next(c for c in bag.connections if c.topic == '/map')
        assert latched.ext.offered_qos_profiles[0].durability.name == 'TRANSIENT_LOCAL'
    assert found == without_sending(bags.told(walk)) == without_sending(bags.told(there))
    with BagReader(there) as one, BagReader(walk) as other:
        assert [e.name for f in one.files for e in f.extras()][:2] == ['calibration.yaml', 'site']
        assert {c[:7] for c in one.connections} == {c[:7] for c in other.connections}
    EditRequest(storage='').make([there], back)
    assert without_sending(bags.judged(back)) == found
    assert bags.extras(back) == bags.EXTRAS


def test_some_topics_and_times_of_two_bags(tmp_path):
    walk, other = bags.write(tmp_path / 'a'), bags.write(tmp_path / 'b', topics=('/x',), start=101)
    topics = Selection(topics=('/a', '/x'))
    request = EditRequest(topics, begin='1', end='2', storage='sqlite3')
    request.make([walk, other], tmp_path / 'new')
    found = bags.told(tmp_path / 'new')
    assert {m[0] for m in found} == {'/a', '/x'}
    assert [m[1] for m in found] == sorted(m[1] for m in found)
    assert all(101 * bags.SECOND <= m[1] < 102 * bags.SECOND for m in found)
    assert len(found) == 3 + 10


def test_a_time_that_sqlite3_cannot_hold_is_refused_and_leaves_nothing(tmp_path):
    with BagWriter(tmp_path / 'late') as bag:
        topic = bag.add_topic('/a', 'a/msg/A', 'int8 x', type_hash='')
        bag.write(topic, 2**63, b'\0\1\0\0\1')
    with pytest.raises(SignalError, match='the year 2262'):
        EditRequest(storage='sqlite3').make([tmp_path / 'late'], tmp_path / 'new')
    assert [path.name for path in tmp_path.iterdir()] == ['late']


def test_a_full_disk_is_told(tmp_path, monkeypatch):
    import sqlite3

    from agv_motion.bag.sqlite.writer import SqliteWriter

    def full(self, rows):
        msg = 'database or disk is full'
        raise sqlite3.OperationalError(msg)

    monkeypatch.setattr(SqliteWriter, 'write', full)
    walk = bags.write(tmp_path / 'walk')
    with pytest.raises(SourceError, match='disk is full'):
        EditRequest(storage='sqlite3').make([walk], tmp_path / 'new')
    assert [path.name for path in tmp_path.iterdir()] == ['walk']


def write_one(folder, definition, **how):
    with BagWriter(folder) as bag:
        topic = bag.add_topic('/a', 'a/msg/A', definition, type_hash='', **how)
        bag.write(topic, bags.SECOND, b'\0\1\0\0\1')
    return folder


def test_a_type_that_is_defined_in_two_ways_is_refused(tmp_path):
    """The table of types has place for one, by which messages of the other were read, too."""
    both = [write_one(tmp_path / str(i), f'int8 {name}\n') for i, name in enumerate('xy')]
    with pytest.raises(ConfigurationError, match='a/msg/A on /a is defined in two ways'):
        EditRequest(storage='sqlite3').make(both, tmp_path / 'new')
    assert not (tmp_path / 'new').exists()


def test_other_comments_are_no_other_definition_and_all_offers_are_kept(tmp_path):
    one = write_one(tmp_path / 'a', 'int8 x\n')
    other = write_one(tmp_path / 'b', '# x\nint8 x # x', qos=(OfferedQos(depth=3),))
    EditRequest(storage='sqlite3').make([one, other], tmp_path / 'new')
    with BagReader(tmp_path / 'new') as bag:
        assert bag.counts == {'/a': 2}
        assert [qos.depth for qos in bag.topics['/a'].qos] == [10, 3]
