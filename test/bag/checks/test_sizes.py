"""What each topic takes, by the indexes alone."""

from __future__ import annotations

import pytest

from agv_motion.bag import BagReader, BagWriter
from agv_motion.bag.checks.sizes import sizes
from agv_motion.bag.editing.request import EditRequest

HEAD = 31
"""[bytes] before each message in MCAP"""


@pytest.mark.parametrize('compression', ['none', 'zstd'])
def test_sizes_are_those_of_the_messages(tmp_path, compression):
    with BagWriter(tmp_path / 'bag', compression=compression, chunk_size=900) as bag:
        a, b = (bag.add_topic(n, 'a/msg/A', 'uint8[] x', type_hash='') for n in ('/a', '/b'))
        for i in range(60):
            if i == 45:
                bag.split()
            bag.write((a, b)[i % 3 == 0], i, b'\0\1\0\0' + bytes(40 if i % 3 == 0 else 10))
    with BagReader(tmp_path / 'bag') as bag:
        found = sizes(bag)
        chunks = sum(chunk.length for file in bag.files for chunk in file.chunks)
    assert {t: one.size for t, one in found.items()} == {
        '/a': 40 * (14 + HEAD), '/b': 20 * (44 + HEAD),
    }  # fmt: skip
    assert sum(one.stored for one in found.values()) == pytest.approx(chunks)
    EditRequest(storage='sqlite3').make([tmp_path / 'bag'], tmp_path / 'db3')
    with BagReader(tmp_path / 'db3') as bag:
        assert {t: one.size for t, one in sizes(bag).items()} == {'/a': 40 * 14, '/b': 20 * 44}
