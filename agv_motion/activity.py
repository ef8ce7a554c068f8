"""What a robot does now, and which part of it or of the world that goes back to: for programs.

People read sentences; whoever decides anything (a page that takes a colour, a chain of reasons)
goes by these two words, which the nodes that command a robot tell in their diagnostics as
`activity` and `because`.
"""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple


class Activity(Enum):
    """What a robot does, as the node that commands it decided."""

    WALKING = 'walking'
    """a tree goes to a place"""
    DRIVING = 'driving'
    """the same of a robot on wheels"""
    TURNING = 'turning'
    """on the spot"""
    WAITING = 'waiting'
    """for somebody: another tree, a goal, a route, a start"""
    RESTING = 'resting'
    """stands as it should: no sap flows, at home, asked to"""
    PAUSED = 'paused'
    CLOSED = 'closed'
    """out of its hours"""
    BLOCKED = 'blocked'
    """told to move, and does not"""
    STOPPED = 'stopped'
    """stands as it should not: an input is lost, no path, outside its zone"""
    STARTING = 'starting'
    """has not heard yet what it needs"""
    ARRIVED = 'arrived'
    FAILED = 'failed'

    @property
    def moves(self) -> bool:
        """Whether the robot is to move."""
        return self in {Activity.WALKING, Activity.DRIVING, Activity.TURNING}


class Cause(Enum):
    """What an activity goes back to."""

    GOAL = 'goal'
    """it does what it is there for: goes to its goal, or has reached it"""
    PERSON = 'person'
    """somebody asked for it"""
    HOURS = 'hours'
    SAP = 'sap'
    """so little flows that a tree rests"""
    PROBES = 'probes'
    """one cannot be believed"""
    SAP_FLOW = 'sap flow'
    """it is silent"""
    POSE = 'pose'
    """it is silent"""
    CLOCK = 'clock'
    """it cannot be believed"""
    ZONE = 'zone'
    """the robot is outside of it, or no path leads through it"""
    OTHERS = 'others'
    """other robots have the floor"""
    MOTION = 'motion'
    """the robot does not do what it is told"""
    NOTHING = 'nothing'
    """nobody has told it what to do"""


class HeldBy(Enum):
    """Who or what holds the wheels of a robot, as the node that commands them tells (`held by`)."""

    NOBODY = 'nobody'
    PERSON = 'person'
    """by ~/stop"""
    ARBITER = 'arbiter'
    """it tells them to stand: a STOP holds, or a dead-man was let go"""
    FIGHT = 'fight'
    """turrets pull against each other"""
    ENCODERS = 'encoders'
    """they are silent"""
    ANGLES = 'angles'
    """of a turret cannot be believed"""
    BLOCKED = 'blocked'
    """wheels do not turn though told to"""


class Doing(NamedTuple):
    """What a robot does, in words and for programs."""

    state: str
    """what it does and why, in words"""
    activity: Activity
    because: Cause
    waits_for: str = ''
    """another robot, in words; empty if it waits for none"""
