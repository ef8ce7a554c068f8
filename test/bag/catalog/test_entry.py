"""What an index tells of a bag."""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace as Some

sys.path.append(str(Path(__file__).parents[1] / 'editing'))

import bags

from agv_motion.bag.catalog.discovery import size
from agv_motion.bag.catalog.entry import EntryReading, _some, entry_of
from agv_motion.bag.metadata import Topic
from agv_motion.bag.sqlite.writer import SqliteWriter
from agv_motion.bag.writer import BagWriter

SECOND = 10**9
MAY = 1_714_521_600


def test_an_entry_is_what_the_bag_tells(season):
    entry = entry_of(season / 'b')
    assert (entry.start, entry.end) == ((MAY + 200) * SECOND, (MAY + 204) * SECOND - SECOND // 10)
    assert (entry.messages, entry.fault, entry.size) == (41, '', size(season / 'b'))
    assert [(t.name, t.type, t.messages) for t in entry.topics] == [
        ('/a', bags.TEXT, 20), ('/x', bags.TEXT, 20), ('/map', bags.TEXT, 1),
    ]  # fmt: skip
    # 31 bytes before each, 8 of CDR, the word and its zero; of "word 0" to "39" 5 have a digit each
    assert [t.size for t in entry.topics] == [20 * 47 - 5, 20 * 47 - 5, 31 + 8 + 4]
    assert 'agv bag recover' in entry_of(season / 'loose.mcap').fault
    gone = entry_of(season / 'gone')
    assert 'does not exist' in gone.fault
    assert gone == (0, 0, 0, 0, gone.fault, ())
    torn = entry_of(season / 'loose.mcap')
    assert {topic.size for topic in torn.topics} == {None}


def test_each_type_of_a_topic_that_changed_it_has_its_own_messages(tmp_path):
    """31 bytes before each message, 4 of CDR, and 1 or 4 of data."""
    with BagWriter(tmp_path / 'bag') as bag:
        for kind, data, count in (('a/msg/A', b'\1', 2), ('a/msg/B', b'\1\0\0\0', 5)):
            field = 'int8 x' if len(data) == 1 else 'int32 x'
            topic = bag.add_topic('/a', kind, field, type_hash='')
            for stamp in range(count):
                bag.write(topic, stamp, b'\0\1\0\0' + data)
    assert entry_of(tmp_path / 'bag').topics == (
        ('/a', 'a/msg/A', 2, 2 * 36.0), ('/a', 'a/msg/B', 5, 5 * 39.0),
    )  # fmt: skip


def test_what_is_wrong_is_told_with_how_much_more_is(tmp_path):
    base = SqliteWriter(tmp_path / 'a.db3')
    base.add_topic(Topic('/a', 'a/msg/A', 'int8 x', '', ()))
    base.write([(1, 5, b'\0\1\0\0\1'), (9, 6, b'')])
    base.close('')
    entry = entry_of(tmp_path / 'a.db3')
    assert entry.fault.endswith('their data; the others are read')
    assert (entry.messages, entry.topics) == (1, (('/a', 'a/msg/A', 1, None),))
    with BagWriter(tmp_path / 'bag') as bag:
        topic = bag.add_topic('/a', 'a/msg/A', 'int8 x', type_hash='')
        for stamp in range(3):
            bag.write(topic, stamp, b'\0\1\0\0\1')
            bag.split()
    for number in (1, 2):  # which is not there, and that messages are missing
        (tmp_path / 'bag' / f'bag_{number}.mcap').unlink()
        assert entry_of(tmp_path / 'bag').fault.endswith(f'others (and {number} more)')


def test_what_cannot_be_looked_at_has_a_fault_alone(tmp_path, monkeypatch):
    monkeypatch.setattr('agv_motion.bag.catalog.entry.size', lambda _: open(tmp_path))  # noqa: PTH123, SIM115
    entry = entry_of(tmp_path)
    assert 'directory' in entry.fault
    assert entry == (0, 0, 0, 0, entry.fault, ())


def test_bags_may_be_read_in_other_processes(season):
    reading, bag = EntryReading(), season / 'b'
    assert reading.run(bag, bag) == (str(bag), entry_of(bag))
    assert (reading.modules(), reading.apart()) == ((), False)
    assert reading.lost(bag, 'killed') == (str(bag), None)


def test_sizes_are_judged_by_chunks_from_everywhere_and_one_of_each_channel(monkeypatch):
    monkeypatch.setattr('agv_motion.bag.catalog.entry.LOOKED_AT', 3)
    channels = [{1: 0}, {1: 0}, {}, {2: 0}, {1: 0}, None, {1: 0}, {2: 0}, {2: 0, 3: 0}, {3: 0}]
    chunks = [Some(number=n, indexes=i, filled=i is None or bool(i))
              for n, i in enumerate(channels)]  # fmt: skip
    assert [chunk.number for chunk in _some(chunks)] == [0, 4, 7, 8]
    assert [chunk.number for chunk in _some(chunks[:4])] == [0, 1, 3]
    assert [chunk.number for chunk in _some(chunks[:5])] == [0, 3]
    assert [chunk.number for chunk in _some(chunks[:2])] == [0, 1]
    assert _some([]) == []
