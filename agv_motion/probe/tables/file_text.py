"""The text of a table: whatever the encoding, and with what a power cut leaves in it."""

from __future__ import annotations

import codecs
from typing import NamedTuple

from agv_motion.errors import SourceError

POWER_CUT = 'only NUL bytes, as a power cut leaves them'
LOOKED_AT = 4096
"""[bytes] by which UTF-16 without a mark is known; and letters by which text is"""
CONTROLS = frozenset(map(chr, range(1, 32))) - set('\t\n\f\r') | {'\x7f'}
"""Characters that no table has; NUL is what a power cut leaves"""
MOST_ODD = 0.02
"""Share of them from which on a file is no text"""
BINARY = {
    b'PK\x03\x04': 'a spreadsheet or an archive: save it as CSV',
    b'\xd0\xcf\x11\xe0': 'a spreadsheet: save it as CSV',
    b'\x1f\x8b': 'compressed: gunzip it',
    b'\xfd7zXZ': 'compressed: unxz it',
    b'"TOB': 'a binary table of Campbell: convert it to TOA5, by CardConvert or LoggerNet',
}
"""What a file is that begins so"""


class FileLine(NamedTuple):
    """A line that has anything in it."""

    number: int
    """counted from 1"""
    text: str
    fault: str = ''
    """why it cannot be read; empty if it can"""


def encoding_of(data: bytes, given: str, file: str) -> str:
    """Return the codec of a file, by its mark, by what it holds, or as it is given.

    Raises:
        SourceError: It is not what is given.

    """
    if given == 'latin-1':
        return given  # every byte is a letter of it
    marks = (codecs.BOM_UTF16_LE, 'utf-16-le'), (codecs.BOM_UTF16_BE, 'utf-16-be')
    marked = next((name for mark, name in marks if data.startswith(mark)), '')
    found = marked or _unmarked_utf16(data[:LOOKED_AT])
    if found and given != 'utf-8':
        return found
    reason = 'it has no mark of UTF-16, and not every second byte is 0'
    if given != 'utf-16':
        try:
            data.decode('utf-8')
        except UnicodeDecodeError as error:
            reason = str(error)
        else:
            return 'utf-8'
    if given == 'auto':
        return 'latin-1'
    msg = f'{file} is not {given} ({reason}): choose csv.encoding auto, or what it was saved as'
    raise SourceError(msg)


def require_text(data: bytes, told: str, file: str) -> None:
    """Refuse a file that is no text.

    Args:
        data: Its first bytes.
        told: What they are as text.
        file: Its name.

    Raises:
        SourceError: It has characters that no table has; the error says what it may be.

    """
    head = told[:LOOKED_AT]
    known = next((what for begin, what in BINARY.items() if data.startswith(begin)), '')
    odd = sum(character in CONTROLS for character in head)
    if known or odd > MOST_ODD * len(head):
        what = f'it is {known}' if known else f'it begins with {data[:8]!r}'
        msg = f'{file} is no table in text: {what}'
        raise SourceError(msg)


def whole_lines(data: bytes, encoding: str) -> bytes:
    """Return the lines that have their end, which is CR where there is no LF at all."""
    newline, old = ('\n'.encode(encoding), '\r'.encode(encoding))
    newline = newline if newline in data or old not in data else old
    end = data.rfind(newline)
    while end >= 0:
        if not end % len(newline):  # else it is half of one letter and half of the next
            return data[: end + len(newline)]
        end = data.rfind(newline, 0, end)
    return b''


def _unmarked_utf16(head: bytes) -> str:
    """Return the name of UTF-16 if every second byte is none, as of Latin letters in it."""
    even, odd = head[0::2], head[1::2]
    if len(head) < 4:
        return ''
    if odd.count(0) > 0.9 * len(odd) and even.count(0) < 0.1 * len(even):
        return 'utf-16-le'
    if even.count(0) > 0.9 * len(even) and odd.count(0) < 0.1 * len(odd):
        return 'utf-16-be'
    return ''


def lines_of(text: str, first: int = 1) -> list[FileLine]:
    """Return the lines that are not empty, the first of them counted as ``first``."""
    lines = []
    plain = text.removeprefix('\ufeff').replace('\r\n', '\n').replace('\r', '\n')
    for number, line in enumerate(plain.split('\n'), first):
        kept = line.replace('\0', '')
        if kept.strip():
            lines.append(FileLine(number, kept))
        elif '\0' in line:
            lines.append(FileLine(number, '', POWER_CUT))
    return lines
