"""Records put into a file, also where the system takes only a part of them at a time."""

from __future__ import annotations

import pytest

from agv_motion.bag import BagReader
from agv_motion.bag.mcap import output
from agv_motion.bag.mcap.output import McapOutput, NewChunk
from agv_motion.bag.mcap.records import MESSAGE_HEAD, Channel

CONTENT = MESSAGE_HEAD.pack(5, 22 + 4, 7, 0, 3, 3) + b'\0\1\0\0'
CHUNK = NewChunk((3, 3), len(CONTENT), 0, '', CONTENT, {7: b'\3' + bytes(15)})


class Slow:
    """Takes a few bytes at a time, and none once the disk is full."""

    def __init__(self, file, most):
        self._file, self._most = file, most

    def write(self, data):
        if self._file.tell() + len(data) > self._most:
            raise OSError(28, 'No space left on device')
        return self._file.write(data[:5])

    def __getattr__(self, name):
        """Do all else as the file does."""
        return getattr(self._file, name)


@pytest.mark.parametrize('together', [True, False])
def test_pieces_go_out_whole_and_a_full_disk_leaves_what_was_before(
    tmp_path, monkeypatch, together
):
    monkeypatch.setattr(output, '_JOINED', 1 << 20 if together else 0)
    file = McapOutput(tmp_path / 'a.mcap')
    file.add_channel(Channel(7, 0, '/a', 'cdr', {}))
    file.put_chunk(CHUNK)
    before = file.size
    assert (file.start, file.end, file.channel_counts) == (3, 3, {7: 1})
    with monkeypatch.context() as disk:
        disk.setattr(file, '_file', Slow(file._file, before + 60))  # noqa: SLF001 - the disk
        with pytest.raises(OSError, match='No space'):
            file.put_chunk(CHUNK)
        assert (tmp_path / 'a.mcap').stat().st_size == file.size == before
        disk.setattr(file, '_file', Slow(file._file._file, 1 << 20))  # noqa: SLF001
        file.put_chunk(CHUNK)
    assert CHUNK.messages == 1
    file.close({}, sync=False)
    with BagReader(tmp_path / 'a.mcap') as bag:
        assert [m.stamp for m in bag.messages()] == [3, 3]
        assert bag.problems == []
