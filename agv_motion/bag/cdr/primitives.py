"""The numbers of CDR in one table, which columns, rows and codec go by (XCDR version 1).

A number is aligned to its size, counted from behind the header of four bytes; so is the length, a
uint32, that stands before a string (its final zero counts) and before a sequence.
Source: OMG DDS-XTypes 1.3, section 7.4.1.
"""

from __future__ import annotations

from typing import NamedTuple


class Primitive(NamedTuple):
    """How a number lies in a message."""

    size: int
    """[bytes], which is its alignment too"""
    numpy: str
    """its type in numpy, without the order of bytes"""
    code: str
    """its letter in :mod:`struct`"""


PRIMITIVES = {
    'bool': Primitive(1, 'u1', '?'),
    'byte': Primitive(1, 'u1', 'c'),  # an octet: 0 to 255, a bytes of one in messages
    'char': Primitive(1, 'u1', 'B'),
    'int8': Primitive(1, 'i1', 'b'),
    'uint8': Primitive(1, 'u1', 'B'),
    'int16': Primitive(2, 'i2', 'h'),
    'uint16': Primitive(2, 'u2', 'H'),
    'int32': Primitive(4, 'i4', 'i'),
    'uint32': Primitive(4, 'u4', 'I'),
    'int64': Primitive(8, 'i8', 'q'),
    'uint64': Primitive(8, 'u8', 'Q'),
    'float32': Primitive(4, 'f4', 'f'),
    'float64': Primitive(8, 'f8', 'd'),
}
"""By the names of ``.msg`` files."""
LENGTH = PRIMITIVES['uint32']
"""What stands before a string and a sequence."""
NUMPY = {name: primitive.numpy for name, primitive in PRIMITIVES.items()}
NUMPY |= {'length': LENGTH.numpy, 'string': LENGTH.numpy}
"""numpy's names of the primitives, of lengths, and of the codes that stand for texts."""
HEADER = b'\x00\x01\x00\x00'
"""Before every message that is written here: plain CDR, little-endian."""
ENCAPSULATION = len(HEADER)
"""[bytes] before the content of a message: how it is written"""
