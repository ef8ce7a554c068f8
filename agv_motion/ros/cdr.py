"""Messages of rclpy to and from CDR, the same bytes every time.

`rclpy.serialization` leaves what happens to be in memory in the gaps between fields, so equal
messages may differ in their bytes, and it takes several times as long. Here each message class
gets two functions, written out field by field when they are first needed.

Source: OMG, DDS-XTypes 1.3, 7.4.1: XCDR version 1, plain, little-endian.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.ros.cdr_decoder import Decoder
from agv_motion.ros.cdr_encoder import Encoder

if TYPE_CHECKING:
    from collections.abc import Callable


class Codec(NamedTuple):
    """The two directions for one message class."""

    encode: Callable[[Any], bytes]
    """message to bytes"""
    decode: Callable[[bytes], Any]
    """bytes to message; raises `SignalError` where they are none"""


@cache
def codec(kind: Any) -> Codec:
    """Return the functions for a message class.

    Raises:
        ConfigurationError: The class has wide strings, whose form is not settled among vendors.

    """
    return Codec(Encoder(kind).function(), Decoder(kind).function())
