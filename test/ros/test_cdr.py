"""Our CDR against that of rclpy, over every type that is installed."""

from __future__ import annotations

import importlib
import random

import numpy as np
import pytest

pytest.importorskip('rclpy')

from rclpy.serialization import deserialize_message
from rosidl_parser.definition import (
    AbstractNestedType,
    AbstractString,
    AbstractWString,
    Array,
    BasicType,
    NamespacedType,
)

from agv_motion.errors import SignalError
from agv_motion.ros.cdr import codec

PACKAGES = [
    *('builtin_interfaces', 'std_msgs', 'geometry_msgs', 'sensor_msgs', 'nav_msgs'),
    *('diagnostic_msgs', 'rcl_interfaces', 'shape_msgs', 'trajectory_msgs', 'visualization_msgs'),
]


def kinds():
    for package in PACKAGES:
        module = importlib.import_module(f'{package}.msg')
        for name in sorted(dir(module)):
            if name[0].isupper():
                yield getattr(module, name)


def number(name, rng):
    """Return a random value of a primitive type."""
    if name == 'boolean':
        return rng.random() < 0.5
    if name == 'octet':
        return bytes([rng.randrange(256)])
    if name in {'float', 'double'}:
        return float(np.float32(rng.uniform(-9, 9)))
    bits = 8 if name == 'char' else int(name.lstrip('uint'))
    low = -(2 ** (bits - 1)) if name.startswith('int') else 0
    return rng.randrange(low, low + 2**bits)


def value(field, rng):
    """Return a random value for a field."""
    if isinstance(field, BasicType):
        return number(field.typename, rng)
    if isinstance(field, AbstractString):
        return ''.join(rng.choice('aé木_') for _ in range(rng.randrange(6)))
    if isinstance(field, NamespacedType):
        return filled(getattr(importlib.import_module('.'.join(field.namespaces)), field.name), rng)
    count = field.size if isinstance(field, Array) else rng.randrange(4)
    return [value(field.value_type, rng) for _ in range(count)]


def filled(kind, rng):
    """Return a message with random values, set through its own setters."""
    message = kind()
    for slot, field in zip(kind.__slots__, kind.SLOT_TYPES, strict=False):
        setattr(message, slot[1:], value(field, rng))
    return message


def wide(kind):
    def has(field):
        inner = field.value_type if isinstance(field, AbstractNestedType) else field
        if isinstance(inner, NamespacedType):
            return wide(getattr(importlib.import_module('.'.join(inner.namespaces)), inner.name))
        return isinstance(inner, AbstractWString)

    return any(has(field) for field in kind.SLOT_TYPES)


def reads_and_is_read(kind):
    rng = random.Random(kind.__name__)  # noqa: S311 - no secret
    for _ in range(5):
        message = filled(kind, rng)
        data = codec(kind).encode(message)
        assert deserialize_message(data, kind) == message
        assert codec(kind).decode(data) == message
        assert codec(kind).encode(codec(kind).decode(data)) == data


def test_rclpy_reads_what_we_write_and_we_read_it_back():
    tried = [kind for kind in kinds() if not wide(kind)]
    for kind in tried:
        reads_and_is_read(kind)
    assert len(tried) > 100


def test_worked_example():
    from std_msgs.msg import Float64MultiArray, Header

    header = Header(frame_id='ab')
    header.stamp.sec, header.stamp.nanosec = 1, 2
    assert codec(Header).encode(header).hex(' ', -4) == (
        '00010000 01000000 02000000 03000000 616200'
    )
    empty = Float64MultiArray(data=[1.0])
    assert codec(Float64MultiArray).encode(empty).hex(' ', -4) == (
        '00010000 00000000 00000000 01000000 00000000 00000000 0000f03f'
    )


def test_bytes_that_end_too_soon_are_refused():
    from sensor_msgs.msg import JointState

    kind = codec(JointState)
    data = kind.encode(JointState(name=['a'], position=[1.0]))
    for length in range(24):
        with pytest.raises(SignalError, match='JointState'):
            pytest.fail(f'{length} bytes are read as {kind.decode(data[:length])}')


def test_a_value_that_does_not_fit_is_refused():
    from std_msgs.msg import UInt8

    message = UInt8()
    message.data = 300
    with pytest.raises(SignalError, match='UInt8'):
        codec(UInt8).encode(message)
