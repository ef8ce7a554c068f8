"""Transforms as the bytes of a tf2_msgs/TFMessage, for where the package of that type is missing.

PyPI has no wheel of tf2_msgs. The type is a list of geometry_msgs/TransformStamped; its definition
is told by `bag.cdr.definitions` wherever geometry_msgs is installed.

Source: OMG, DDS-XTypes 1.3, 7.4.1: XCDR version 1, plain, little-endian.
"""

from __future__ import annotations

from functools import lru_cache
from struct import Struct
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.model.transform import Transform

TYPE = 'tf2_msgs/msg/TFMessage'
TF, TF_STATIC = '/tf', '/tf_static'
"""Topics of all robots; what is said on the second one holds for good, and is latched."""

_LITTLE_ENDIAN = b'\x00\x01\x00\x00'
_COUNT, _STAMP, _SEVEN = Struct('<I'), Struct('<iI'), Struct('<7d')
_SECOND = 1_000_000_000


def encoded(transforms: Iterable[Transform]) -> bytes:
    """Return transforms as one message in CDR."""
    several = list(transforms)
    data = _COUNT.pack(len(several))
    for one in several:
        data += _STAMP.pack(*divmod(one.stamp, _SECOND))
        data += _names(one.parent, one.child, len(data) % 8)
        data += _SEVEN.pack(*one.translation, *one.rotation)
    return _LITTLE_ENDIAN + data


@lru_cache(maxsize=1024)
def _names(parent: str, child: str, begin: int) -> bytes:
    """Return both names, filled up to where numbers of eight bytes may follow.

    Args:
        parent: Frame.
        child: Frame.
        begin: Where they begin, counted from a multiple of eight [bytes]: 4 or 0.

    """
    data = bytes(begin)
    for name in (parent, child):
        content = name.encode() + b'\0'
        data += bytes(-len(data) % 4) + _COUNT.pack(len(content)) + content
    return data[begin:] + bytes(-len(data) % 8)
