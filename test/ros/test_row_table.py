"""Rows become messages: one at a time, and many together to the bit the same."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip('rclpy')

from agv_motion.errors import SignalError
from agv_motion.planar import Twist
from agv_motion.ros.cdr import codec
from agv_motion.ros.messages import TurretJoints
from agv_motion.ros.row_table import SECOND, Table
from agv_motion.ros.turret_rows import TurretRows
from agv_motion.ros.twist_rows import TwistRows

NUMBERS = st.floats(-1e6, 1e6)
STAMPS = st.lists(st.integers(0, 2**31 * SECOND - 1), min_size=1, max_size=5)
TWISTS, TURRETS = TwistRows('base_link'), TurretRows(TurretJoints(3), 3, 'base_link')


def one_by_one(rows, stamps, values):
    """Return each row as a message of its own."""
    message = rows.message()
    made = []
    for stamp, value in zip(stamps, values, strict=True):
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, SECOND)
        rows.fill(message, value)
        made.append(codec(type(message)).encode(message))
    return made


@given(STAMPS, st.data())
def test_twists(stamps, data):
    twists = [Twist(*data.draw(st.tuples(NUMBERS, NUMBERS, NUMBERS))) for _ in stamps]
    together = Table(TWISTS).messages(np.array(stamps, np.int64), twists)
    assert together == one_by_one(TWISTS, stamps, twists)


@given(STAMPS, st.data())
def test_turrets(stamps, data):
    three = st.lists(NUMBERS, min_size=3, max_size=3)
    commands = [data.draw(st.tuples(three, three)) for _ in stamps]
    together = Table(TURRETS).messages(np.array(stamps, np.int64), commands)
    assert together == one_by_one(TURRETS, stamps, commands)


def test_a_row_that_is_written_is_read_again():
    twist, turrets = TWISTS.message(), TURRETS.message()
    TWISTS.fill(twist, Twist(0.1, -0.2, 0.3))
    assert TWISTS.read(twist) == (0.1, -0.2, 0.3)
    TURRETS.fill(turrets, ([1.0, 2.0, 3.0], [-1.0, -2.0, -3.0]))
    assert TURRETS.read(turrets) == ([1.0, 2.0, 3.0], [-1.0, -2.0, -3.0])


def test_a_number_that_is_none_is_refused():
    message = TWISTS.message()
    message.twist.angular.z = float('nan')
    with pytest.raises(SignalError, match=r'twist .* must be finite'):
        TWISTS.read(message)
