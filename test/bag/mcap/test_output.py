"""Records put into a file, also where the system takes only a part of them at a time."""

from __future__ import annotations

from contextlib import closing
from struct import pack

import pytest

from agv_motion.bag import BagReader
from agv_motion.bag.mcap import output
from agv_motion.bag.mcap.file import McapFile
from agv_motion.bag.mcap.message_index import rows
from agv_motion.bag.mcap.output import McapOutput, NewChunk
from agv_motion.bag.mcap.records import MESSAGE_HEAD, Attachment, Channel, Metadata
from agv_motion.bag.mcap.summary import read

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


def entries(*pairs):
    return b''.join(pack('<2Q', *pair) for pair in pairs)


def filled(path):
    """Return a file with two chunks of two channels, an attachment before each, and a note."""
    file = McapOutput(path)
    for number in (7, 9):
        file.add_channel(Channel(number, 0, f'/{number}', 'cdr', {}))
    file.keep(Attachment(1, 2, 'first', '', b'1'))
    file.put_chunk(CHUNK._replace(times=(3, 9), indexes={9: entries((9, 30)), 7: entries((3, 0))}))
    file.keep(Attachment(1, 2, 'second', '', b'2'))
    file.keep(Metadata('site', {}))
    file.put_chunk(CHUNK._replace(times=(1, 5), indexes={7: entries((1, 0), (5, 30))}))
    return file


def told(path):
    data = memoryview(path.read_bytes())
    return data, read(data, path)


def test_the_summary_tells_what_was_put_and_where(tmp_path):
    file = filled(tmp_path / 'a.mcap')
    assert (file.start, file.end, file.channel_counts) == (1, 9, {7: 3, 9: 1})
    file.close({'a': 'b'})
    data, summary = told(file.path)
    assert summary.statistics == (4, 0, 2, 2, 2, 2, 1, 9, {7: 3, 9: 1})
    first, second = summary.chunks
    assert [(c.start, c.end, c.size) for c in summary.chunks] == [(3, 9, 35), (1, 5, 35)]
    for chunk, channel, expected in (
        (first, 7, [[3, 0]]), (first, 9, [[9, 30]]), (second, 7, [[1, 0], [5, 30]]),
    ):  # fmt: skip
        found = rows(data, channel, chunk.indexes[channel], file.path)
        assert found.tolist() == expected
    assert (first.index_length, second.index_length) == (2 * 15 + 2 * 16, 15 + 2 * 16)
    with closing(McapFile(file.path)) as bag:
        names = [getattr(extra, 'name', extra) for extra in bag.extras()]
    assert names == ['first', 'second', 'site', 'rosbag2']


def test_a_dropped_chunk_takes_along_what_came_after_it(tmp_path):
    file = filled(tmp_path / 'a.mcap')
    file.keep(Attachment(1, 2, 'third', '', b'3'))
    assert file.drop_chunk()
    assert (file.start, file.end, file.channel_counts) == (3, 9, {7: 1, 9: 1})
    file.close({})
    assert told(file.path)[1].statistics == (2, 0, 2, 2, 2, 1, 3, 9, {7: 1, 9: 1})
    file = filled(tmp_path / 'b.mcap')
    assert (file.drop_chunk(), file.drop_chunk(), file.drop_chunk()) == (True, True, False)
    assert (file.start, file.end, file.channel_counts) == (2**64 - 1, 0, {7: 0, 9: 0})
    file.close({})
    assert told(file.path)[1].statistics == (0, 0, 2, 1, 1, 0, 0, 0, {})


@pytest.mark.parametrize('sync', [True, False])
def test_it_waits_for_the_disk_if_it_is_told_to(tmp_path, monkeypatch, sync):
    waited = []
    monkeypatch.setattr('os.fdatasync', waited.append)
    McapOutput(tmp_path / 'a.mcap').close({}, sync=sync)
    assert len(waited) == sync
