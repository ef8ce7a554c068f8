"""What a robot behind its Ghost is doing, in one word."""

from __future__ import annotations

from enum import Enum


class FollowerState(Enum):
    """What the robot and its Ghost are doing."""

    IDLE = 'idle'
    LOCKED = 'locked'
    DRIVING = 'driving'
    WAITING = 'waiting'
    """The Ghost waits for the robot"""
    SETTLING = 'settling'
    """The Ghost has arrived, the robot closes the last centimetres"""
    CORRECTING = 'correcting'
    """The robot is led to where its Ghost stands"""
    ARRIVED = 'arrived'
    ABORTED = 'aborted'
    LOST = 'lost'
    NOT_ARRIVED = 'not arrived'
    """The robot could not be brought to where its Ghost stands"""


AT_REST = frozenset(
    {
        FollowerState.IDLE,
        FollowerState.ARRIVED,
        FollowerState.ABORTED,
        FollowerState.LOST,
        FollowerState.NOT_ARRIVED,
    }
)
"""In these states nothing moves until there is a new trajectory."""
