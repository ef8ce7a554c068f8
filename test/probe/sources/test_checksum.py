"""Checksums of lines: known ones, and every change of one character."""

from __future__ import annotations

import pytest

from agv_motion.errors import SignalError
from agv_motion.probe.sources.checksum import Checksum, checked

KNOWN = [
    (
        Checksum.XOR,
        '$GPGLL,5300.97914,N,00259.98174,E,125926,A*28',
        'GPGLL,5300.97914,N,00259.98174,E,125926,A',
    ),
    (Checksum.SUM, 'ab,C3', 'ab'),
    (Checksum.CRC16, '123456789;31C3', '123456789'),
]


@pytest.mark.parametrize(('kind', 'line', 'text'), KNOWN)
def test_a_known_line_comes_without_its_checksum_in_letters_of_either_size(kind, line, text):
    assert checked(line, kind) == text
    assert checked(f'{line.lower() if kind is Checksum.SUM else line} \r', kind) == text


@pytest.mark.parametrize(('kind', 'line', '_'), KNOWN)
def test_a_changed_character_is_noticed(kind, line, _):
    wrong = chr(ord(line[0]) ^ 1) + line[1:]
    with pytest.raises(SignalError, match=r'its checksum is .*, that of its text'):
        checked(wrong, kind)


def test_a_line_without_one_is_refused_only_where_one_is_wanted():
    assert checked('1.5, 2.5', Checksum.NONE) == '1.5, 2.5'
    with pytest.raises(SignalError, match=r'no checksum \(xor\) at its end'):
        checked('1.5 2.5', Checksum.XOR)
