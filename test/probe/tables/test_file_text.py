"""The encoding of a file by its mark or by what it holds; lines whole, numbered, without NULs."""

from __future__ import annotations

import pytest

from agv_motion.errors import SourceError
from agv_motion.probe.tables.file_text import (
    POWER_CUT,
    encoding_of,
    lines_of,
    require_text,
    whole_lines,
)

TABLE = 'Zeit;ΔT °C\n01.06.2013 10:00;8,25\n'


@pytest.mark.parametrize('codec', ['utf-8', 'utf-16-le', 'utf-16-be'])
@pytest.mark.parametrize('mark', ['', '\ufeff'])
def test_an_encoding_is_known_by_its_mark_and_without_one(codec, mark):
    assert encoding_of((mark + TABLE).encode(codec), 'auto', 'x.csv') == codec


def test_what_is_no_unicode_is_latin():
    assert encoding_of('8,25 °C\n'.encode('latin-1'), 'auto', 'x.csv') == 'latin-1'
    assert encoding_of(TABLE.encode(), 'latin-1', 'x.csv') == 'latin-1'


@pytest.mark.parametrize(
    'data',
    [
        b'',
        b'\0',
        b'1\0\n',
        b'1;2\n' * 20,
        b'1;2\n' * 20 + b'\0' * 4,
        b'1\0' + b'22' * 20,
        b'\0' * 40,
    ],
)
def test_few_bytes_or_zeros_everywhere_are_no_utf_16(data):
    assert encoding_of(data, 'auto', 'x.csv') == 'utf-8'


def test_a_few_letters_of_another_script_do_not_hide_utf_16():
    for codec in ('utf-16-le', 'utf-16-be'):
        assert encoding_of(('a' * 90 + 'Δ' * 5 + 'Ā' * 3).encode(codec), 'auto', 'x.csv') == codec
        assert encoding_of(('ab' * 40 + 'ΔΔ' * 10).encode(codec), 'auto', 'x.csv') != codec


@pytest.mark.parametrize(
    ('none', 'some', 'known'), [(91, 9, True), (90, 9, False), (91, 10, False), (100, 100, False)]
)
def test_utf_16_has_more_than_nine_tenths_of_its_other_bytes_zero(none, some, known):
    """And less than a tenth of those that are letters: of 100 pairs, each byte counts."""
    zeros, letters = b'\0' * none + b'a' * (100 - none), b'\0' * some + b'a' * (100 - some)
    for first, second, codec in ((letters, zeros, 'utf-16-le'), (zeros, letters, 'utf-16-be')):
        data = bytes(byte for pair in zip(first, second, strict=True) for byte in pair)
        assert encoding_of(data, 'auto', 'x.csv') == (codec if known else 'utf-8')


def test_two_letters_are_enough_and_what_comes_after_4096_bytes_is_not_looked_at():
    assert encoding_of(b'1\0\n\0', 'auto', 'x.csv') == 'utf-16-le'
    assert encoding_of(b'1\0' * 2048 + b'22' * 2048, 'auto', 'x.csv') == 'utf-16-le'
    assert encoding_of(b'1\0' * 1840 + b'22' * 2048, 'auto', 'x.csv') == 'utf-8'


@pytest.mark.parametrize('odd', ['\x01', '\x08', '\x0b', '\x1f', '\x7f'])
def test_a_text_has_no_more_than_two_control_characters_in_a_hundred(odd):
    require_text(b'', odd * 2 + 'a' * 98, 'x.csv')
    require_text(b'', 'a' * 4096 + odd * 4096, 'x.csv')
    with pytest.raises(
        SourceError, match=r"^x\.csv is no table in text: it begins with b'begins a'$"
    ):
        require_text(b'begins as it does', odd * 3 + 'a' * 97, 'x.csv')


@pytest.mark.parametrize('letter', ['\t', '\n', '\f', '\r', '\0', ' ', '~', '\x80'])
def test_what_tables_hold_is_text_however_much_of_it_there_is(letter):
    require_text(b'', letter * 100, 'x.csv')


def test_a_kind_of_file_is_known_by_how_it_begins():
    with pytest.raises(SourceError, match=r'^x is no table in text: it is compressed: gunzip it$'):
        require_text(b'\x1f\x8b12', 'a' * 100, 'x')
    require_text(b'1\x1f\x8b', 'a' * 100, 'x')


@pytest.mark.parametrize(
    ('data', 'given', 'word'),
    [(TABLE.encode(), 'utf-16', 'no mark of UTF-16'), (b'\xb0C\n', 'utf-8', "can't decode")],
)
def test_what_is_not_as_it_is_given_is_refused(data, given, word):
    with pytest.raises(SourceError, match=rf'x\.csv is not {given} \(.*{word}'):
        encoding_of(data, given, 'x.csv')


@pytest.mark.parametrize('codec', ['utf-8', 'utf-16-le', 'utf-16-be'])
@pytest.mark.parametrize('rest', ['', '8', '8,2\u0a0a\u000a0'[:4]])
def test_a_line_that_has_no_end_yet_is_left(codec, rest):
    assert whole_lines((TABLE + rest).encode(codec), codec) == TABLE.encode(codec)
    assert whole_lines('8,25'.encode(codec), codec) == b''


@pytest.mark.parametrize('codec', ['utf-8', 'utf-16-le', 'utf-16-be'])
@pytest.mark.parametrize(
    ('text', 'whole'),
    [
        ('a\rb\rc', 'a\rb\r'),  # as an old Macintosh ends them
        ('a\r\nb\rc', 'a\r\n'),
        ('a\nb', 'a\n'),
        ('\n\u0100\u0a61\u0100', '\n'),  # half a letter each of two make a newline too
        ('ab\n\u0100\u0a61\u0100\u0a61\u0100', 'ab\n'),
        ('\u0100\u0a61\u0100', ''),
        ('ab', ''),
        ('', ''),
    ],
)
def test_a_line_ends_with_lf_or_where_there_is_none_with_cr(codec, text, whole):
    assert whole_lines(text.encode(codec), codec) == whole.encode(codec)


def test_lines_are_counted_as_an_editor_does_and_a_power_cut_is_told():
    found = lines_of('\ufeffa\r\n\n  \n\0\0\0\nb\0c\rd', first=10)
    assert [(line.number, line.text, line.fault) for line in found] == [
        (10, 'a', ''), (13, '', POWER_CUT), (14, 'bc', ''), (15, 'd', ''),
    ]  # fmt: skip
