"""What latched topics had told: as many messages as their publishers keep."""

from __future__ import annotations

from agv_motion.bag import BagReader, BagWriter, OfferedQos
from agv_motion.bag.editing.latched import latched_before
from agv_motion.bag.selection import Selection

KEPT = OfferedQos(durability='transient_local', depth=2)
ALL = Selection(everything=True, hidden=True)


def test_as_many_as_are_kept_with_the_stamp_of_the_moment(tmp_path):
    with BagWriter(tmp_path / 'bag', chunk_size=1) as bag:
        latched, other = (
            bag.add_topic(name, 'a/msg/A', 'int8 x', type_hash='', qos=qos)
            for name, qos in (('/state', (KEPT,)), ('/talk', (OfferedQos(),)))
        )
        for i in range(5):
            bag.write(latched, 10 * i, b'\0\1\0\0' + bytes((i,)), 3, 4)
            bag.write(other, 10 * i, b'\0\1\0\0\0')
    with BagReader(tmp_path / 'bag') as bag:
        found = latched_before([bag], ALL, 30)
        assert [(m.stamp, m.publish, m.sequence, m.data[-1]) for m in found] == [
            (30, 3, 4, 1), (30, 3, 4, 2),
        ]  # fmt: skip
        assert [m.data[-1] for m in latched_before([bag], ALL, 30, 20)] == [2]
        assert latched_before([bag], ALL, 0) == []
        assert latched_before([bag], Selection(topics=('/talk',)), 30) == []
