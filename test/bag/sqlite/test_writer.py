"""The tables are those of rosbag2."""

from __future__ import annotations

import sqlite3

from agv_motion.bag import OfferedQos
from agv_motion.bag.metadata import Topic
from agv_motion.bag.sqlite.writer import SqliteWriter


def test_rows_and_tables(tmp_path):
    path = tmp_path / 'a.db3'
    writer = SqliteWriter(path, 'kilted')
    for name in ('/a', '/b'):
        writer.add_topic(Topic(name, 'a/msg/A', 'int8 x', 'RIHS01_1', (OfferedQos(),)))
    writer.write([(1, 5, b'one'), (2, 4, b'two')])
    writer.close('described')
    base = sqlite3.connect(path)
    assert base.execute('select * from schema').fetchall() == [(4, 'kilted')]
    assert base.execute('select * from metadata').fetchall() == [(1, 9, 'described')]
    topics = base.execute('select id, name, type, serialization_format, type_description_hash '
                          'from topics').fetchall()  # fmt: skip
    assert topics == [(n, name, 'a/msg/A', 'cdr', 'RIHS01_1') for n, name in ((1, '/a'), (2, '/b'))]
    kinds = base.execute('select * from message_definitions').fetchall()
    assert kinds == [(1, 'a/msg/A', 'ros2msg', 'int8 x', 'RIHS01_1')]
    rows = base.execute('select * from messages order by timestamp').fetchall()
    assert rows == [(2, 2, 4, b'two'), (1, 1, 5, b'one')]
    indexes = base.execute("select name from sqlite_master where type = 'index'").fetchall()
    assert indexes == [('timestamp_idx',)]
    assert base.execute('pragma integrity_check').fetchall() == [('ok',)]
    base.close()
