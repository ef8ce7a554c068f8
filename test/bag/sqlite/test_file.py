"""Files of sqlite3 with rows that nobody should have written, and tables of every version."""

from __future__ import annotations

import sqlite3
from concurrent.futures import ThreadPoolExecutor

import pytest

from agv_motion.bag.columns import message_batches
from agv_motion.bag.editing.recovery import Recovery
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import SourceError

TOPICS = 'id integer primary key, name text, type text, serialization_format text'
MESSAGES = 'id integer primary key, topic_id integer, timestamp integer, data blob'
DATA = b'\0\1\0\0\7\0\0\0'


def written(path, *statements, more=''):
    """Write two topics with ten messages each at 1 to 20 ns, then do as the statements say."""
    base = sqlite3.connect(path)
    base.execute(f'create table topics ({TOPICS}{more})')
    base.execute(f'create table messages ({MESSAGES})')
    for number, name in ((1, '/a'), (2, '/b')):
        row = (number, name, 'std_msgs/msg/Int32', 'cdr', *['{{{'] * bool(more))
        base.execute(f'insert into topics values ({", ".join("?" * len(row))})', row)  # noqa: S608
    for i in range(20):
        row = (i % 2 + 1, i + 1, DATA)
        base.execute('insert into messages (topic_id, timestamp, data) values (?, ?, ?)', row)
    for statement in statements:
        base.execute(statement)
    base.commit()
    base.close()
    return path


SPOILT = {
    'no data': 'update messages set data = null where id = 5',
    'text for data': "update messages set data = 'abc' where id = 5",
    'no time': 'update messages set timestamp = null where id = 5',
    'text for a time': "update messages set timestamp = 'abc' where id = 5",
    'a time before 1970': 'update messages set timestamp = -5 where id = 5',
    'a topic that is not there': 'update messages set topic_id = 9 where id = 5',
}


@pytest.mark.parametrize('statement', SPOILT.values(), ids=SPOILT)
def test_a_row_that_is_no_message_is_told_and_the_others_are_read(tmp_path, statement):
    path = written(tmp_path / 'a.db3', statement)
    with BagReader(path) as bag:
        (problem,) = bag.problems
        assert 'a.db3, table messages: 1 of 20 rows are no messages' in str(problem)
        assert bag.lossy
        assert bag.counts == {'/a': 9, '/b': 10}
        assert (bag.start, bag.end) == (1, 20)
        assert [m.stamp for m in bag.messages()] == [*range(1, 5), *range(6, 21)]
        assert [m.stamp for m in bag.messages(['/a'], start=3, stop=9)] == [3, 7]
    with BagWriter(tmp_path / 'saved') as writer:
        recovery = Recovery(writer)
        recovery.save(path)
    assert recovery.messages == 19
    assert all('a.db3' in str(found) for found in recovery.problems)
    assert recovery.problems


def test_a_topic_without_a_name_costs_its_messages_only(tmp_path):
    path = written(tmp_path / 'a.db3', 'update topics set name = null where id = 1')
    with BagReader(path) as bag:
        assert '10 of 20 rows' in str(bag.problems[0])
        assert bag.counts == {'/b': 10}


def test_a_quality_of_service_that_cannot_be_read_costs_nothing(tmp_path):
    with BagReader(written(tmp_path / 'a.db3', more=', offered_qos_profiles text')) as bag:
        assert not bag.problems
        assert bag.counts == {'/a': 10, '/b': 10}
        assert bag.topics['/a'].qos == ()


@pytest.mark.parametrize('table', ['topics', 'messages'])
def test_a_database_of_something_else_is_told(tmp_path, table):
    path = written(tmp_path / 'a.db3', f'drop table {table}')
    with pytest.raises(SourceError, match=r'a\.db3 is a database, but no bag'):
        BagReader(path)
    with BagWriter(tmp_path / 'saved') as writer:
        recovery = Recovery(writer)
        recovery.save(path)
    assert [str(found).count('a.db3') for found in recovery.problems] == [1]


def test_any_thread_reads_and_times_beyond_the_last_hold_nothing(tmp_path):
    with BagReader(written(tmp_path / 'a.db3')) as bag, ThreadPoolExecutor(1) as other:
        assert other.submit(lambda: len(list(bag.messages()))).result() == 20
        assert list(bag.messages(start=2**63)) == list(bag.messages([])) == []


def test_messages_are_handed_over_a_few_at_a_time(tmp_path, monkeypatch):
    """Of ten on /a at most three; those of 8 bytes each, more than 20 bytes or more are enough."""
    found = []
    for limit, value, expected in (('_TOGETHER', 3, [3, 3, 3, 1]), ('_MOST', 20, [3, 3, 3, 1])):
        with monkeypatch.context() as change, BagReader(written(tmp_path / limit)) as bag:
            change.setattr(message_batches, limit, value)
            found.clear()
            bag.files[0].batches([1], 0, 2**64, lambda batch: found.append(len(batch.stamps)))
            assert found == expected
