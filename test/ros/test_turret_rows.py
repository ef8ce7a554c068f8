"""Commands to the turrets as messages, one or many."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip('rclpy')

from sensor_msgs.msg import JointState

from agv_motion.errors import SignalError
from agv_motion.ros.cdr import codec
from agv_motion.ros.messages import TurretJoints
from agv_motion.ros.row_table import Table
from agv_motion.ros.turret_rows import TurretRows

JOINTS = TurretJoints(2)
ROWS = [([0.1, -0.2], [3.0, 4.0]), ([0.5, 0.6], [-7.0, 8.0])]


def test_there_and_back():
    rows = TurretRows(JOINTS, 2, 'base_link')
    message = rows.message()
    assert message.header.frame_id == 'base_link'
    rows.fill(message, ROWS[0])
    assert message.position.tolist() == [0.1, -0.2, 0.0, 0.0]
    assert message.velocity.tolist() == [0.0, 0.0, 3.0, 4.0]
    angles, rates = rows.read(message)[:2]
    assert (list(angles), list(rates)) == ROWS[0]
    message.name = ['somebody'] * len(message.name)
    with pytest.raises(SignalError, match='turret_0_steering'):
        rows.read(message)


def test_many_together_are_the_bytes_of_each():
    rows, codes, wanted = TurretRows(JOINTS, 2, 'base_link'), codec(JointState), []
    for row, stamp in zip(ROWS, (5, 1_000_000_007), strict=True):
        message = rows.message()
        rows.fill(message, row)
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, 10**9)
        wanted.append(codes.encode(message))
    assert Table(rows).messages(np.array([5, 1_000_000_007]), ROWS) == wanted
