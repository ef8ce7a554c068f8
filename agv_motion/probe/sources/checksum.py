"""Checksums at the end of a line, which tell whether it came as it was sent."""

from __future__ import annotations

import binascii
import re
from enum import Enum
from functools import reduce
from operator import xor

from agv_motion.errors import SignalError

_END = re.compile(r'(?P<text>.*)[*,;](?P<sum>[0-9A-Fa-f]{2}|[0-9A-Fa-f]{4})\s*')


class Checksum(Enum):
    """What is added up over the bytes of a line, from its first to before its last * or comma."""

    NONE = 'none'
    XOR = 'xor'
    """exclusive or, as NMEA 0183 does; a $ at the beginning does not count"""
    SUM = 'sum'
    """sum modulo 256"""
    CRC16 = 'crc16'
    """CRC-16 of CCITT, polynomial 0x1021, begun with 0 (XMODEM)"""


def checked(text: str, kind: Checksum) -> str:
    """Return a line without its checksum.

    Raises:
        SignalError: It has none, or another than the text has.

    """
    if kind is Checksum.NONE:
        return text
    found = _END.fullmatch(text)
    if found is None:
        msg = f'it has no checksum ({kind.value}) at its end'
        raise SignalError(msg)
    data = found['text'].encode('ascii', errors='replace')
    if kind is Checksum.XOR:
        value = reduce(xor, data.removeprefix(b'$'), 0)
    else:
        value = sum(data) % 256 if kind is Checksum.SUM else binascii.crc_hqx(data, 0)
    if value != int(found['sum'], 16):
        msg = f'its checksum is {found["sum"]}, that of its text {value:02X}'
        raise SignalError(msg)
    return found['text'].removeprefix('$')
