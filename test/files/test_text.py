"""The text of a file: what is none is refused before it is read."""

from __future__ import annotations

import os

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.files import text


@pytest.fixture
def file(tmp_path):
    def written(content):
        path = tmp_path / 'f'
        path.write_bytes(content)
        return path

    return written


@pytest.mark.parametrize('content', [b'a\nb\n', b'\xef\xbb\xbfa\r\nb\r\n', b'a\rb\r'])
def test_line_ends_and_the_mark_of_editors_mean_nothing(file, content):
    assert text.read(file(content)) == 'a\nb\n'


@pytest.mark.parametrize(
    ('content', 'reason'),
    [
        ('ä: 1\nü\n'.encode('latin-1'), 'line 1, column 1: byte 0xe4 is no UTF-8'),
        ('ä: 1\nü'.encode() + b'\xff', 'line 2, column 2: byte 0xff is no UTF-8'),
        ('a: 1'.encode('utf-16'), 'line 1, column 1: it is UTF-16: save it as UTF-8'),
        (b'x' * 101, 'larger than 100 bytes'),
    ],
)
def test_what_is_no_text_is_refused(file, content, reason):
    with pytest.raises(ConfigurationError, match=reason):
        text.read(file(content), limit=100)


def test_what_is_no_file_is_refused_at_once(tmp_path):
    os.mkfifo(tmp_path / 'pipe')
    for path in (tmp_path / 'pipe', tmp_path / 'none', tmp_path):
        with pytest.raises(ConfigurationError, match='cannot read the zone') as refused:
            text.read(path, 'the zone')
        assert 'rrno' not in str(refused.value)
    with pytest.raises(ConfigurationError, match='it is a device or a pipe'):
        text.read(type(tmp_path)('/dev/zero'))
    with pytest.raises(ConfigurationError, match='null'):
        text.read(type(tmp_path)('a\0b'))
