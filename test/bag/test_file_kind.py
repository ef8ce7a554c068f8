"""What a file is, by its first bytes; a suffix counts only where those are damaged."""

from __future__ import annotations

import os

import pytest

from agv_motion.bag.file_kind import MCAP, SQLITE, ZSTD, kind
from agv_motion.bag.mcap.records import MAGIC
from agv_motion.errors import SourceError


def with_bytes(folder, name, data):
    path = folder / name
    path.write_bytes(data)
    return path


@pytest.mark.parametrize(
    ('name', 'data', 'what'),
    [
        ('a.db3', MAGIC + b'...', MCAP),
        ('a.mcap', b'SQLite format 3\0...', SQLITE),
        ('a', b'(\xb5/\xfd...', ZSTD),
        ('a.mcap', b'damaged', MCAP),
        ('a.db3', b'', SQLITE),
    ],
)
def test_by_its_bytes_then_by_its_name(tmp_path, name, data, what):
    assert kind(with_bytes(tmp_path, name, data)) == what


@pytest.mark.parametrize(
    ('data', 'remedy'),
    [
        (b'#ROSBAG V2.0', 'rosbags-convert'),
        (b'\x1f\x8b', 'gunzip -k'),
        (b'version https://git-lfs', 'git lfs pull'),
        (bytes(257) + b'ustar', 'a tar archive: unpack it'),
        (b'hello', r"no bag in MCAP or sqlite3: it begins with b'hello'"),
    ],
)
def test_what_is_something_else_is_told_with_its_remedy(tmp_path, data, remedy):
    with pytest.raises(SourceError, match=remedy):
        kind(with_bytes(tmp_path, 'a.bin', data))


def test_what_is_not_there_is_told(tmp_path):
    with pytest.raises(SourceError, match='cannot be read: No such file'):
        kind(tmp_path / 'nothing.mcap')


def test_nobody_waits_for_a_pipe(tmp_path):
    os.mkfifo(tmp_path / 'pipe.mcap')
    with pytest.raises(SourceError, match=r'pipe\.mcap is no file, but a pipe or a device'):
        kind(tmp_path / 'pipe.mcap')
