"""Who may ask a robot to move: six sources, by rank."""

from __future__ import annotations

from enum import Enum


class TwistSource(Enum):
    """A source of twists; the first outranks all that follow. Its value is its name on the graph.

    `cmd_vel/NAME` is its topic.
    """

    STOP = 'stop'
    """Whoever sees a danger. It latches: whatever it says stops the robot until it is released."""
    MANUAL = 'manual'
    """A person who watches the robot, with a hand on a dead-man: a joystick, the operator's page.
    """
    PAGE = 'page'
    """A goal that a person has given: by the operator's page, RViz or a command."""
    ROUTE = 'route'
    """A route that is followed."""
    SEQUENCE = 'sequence'
    """A sequence of actions."""
    AGENT = 'agent'
    """What drives the robot when nobody asks for anything, as the tree its own sap."""

    __hash__ = object.__hash__  # each is there once; that of Enum hashes the name, in Python


RANKED = tuple(TwistSource)
"""Highest first."""

DRIVERS = RANKED[1:]
"""All that may move the robot: STOP only stands."""

DEAD_MEN = frozenset({TwistSource.MANUAL})
"""Sources whose silence after a motion means that a person has let go, or has lost the link."""
