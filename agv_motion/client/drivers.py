"""The nodes that take orders, and by which topics and services they do."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from std_srvs.srv import SetBool, Trigger

from agv_motion.client.task import Outcome
from agv_motion.trajectory.follower_state import FollowerState

if TYPE_CHECKING:
    from collections.abc import Mapping

ANEW = {
    'not active': Outcome.FAILED, 'waiting for a goal': Outcome.FAILED,
    'waiting for a route': Outcome.FAILED, 'waiting for ~/start': Outcome.FAILED,
    'left the route': Outcome.FAILED,
}  # fmt: skip
"""A node that says so was started anew, or deactivated: it has forgotten its order."""


class Driver(NamedTuple):
    """A node that drives a robot to what it is told."""

    node: str
    state: str
    """topic (std_msgs/String, latched) on which it says what it does"""
    path: str
    """topic (nav_msgs/Path, latched) on which it says where it will go"""
    service: str
    """that ends or halts what it does"""
    request: Any
    """with which that is asked for"""
    ends: Mapping[str, Outcome]
    """how the first words of its state end an order"""

    kind: Any = Trigger
    """class of the service"""


GHOST = Driver(
    'ghost_trajectory', 'ghost/state', 'ghost/path', 'ghost_trajectory/abort', Trigger.Request(),
    ANEW | {
        FollowerState.ARRIVED.value: Outcome.SUCCEEDED,
        FollowerState.ABORTED.value: Outcome.CANCELLED,
        FollowerState.LOST.value: Outcome.FAILED,
        FollowerState.NOT_ARRIVED.value: Outcome.FAILED,
    },
)  # fmt: skip
ROUTE = Driver(
    'route_follower', 'route/state', 'route/path', 'route_follower/abort', Trigger.Request(),
    ANEW | {'arrived': Outcome.SUCCEEDED, 'aborted': Outcome.CANCELLED},
)  # fmt: skip
SEQUENCE = Driver(
    'sequence', 'sequence/state', 'sequence/path', 'sequence/abort', Trigger.Request(),
    ANEW | {
        'done': Outcome.SUCCEEDED, 'aborted': Outcome.CANCELLED, 'failed': Outcome.FAILED,
    },  # of sequence.runner.SequenceState, which would bring all of its room
)  # fmt: skip
TREE = Driver(
    'motion_generator', 'state', 'path', 'motion_generator/pause', SetBool.Request(data=True), {},
    SetBool,
)  # fmt: skip
"""It has arrived where it is near its goal; it is never done: then it takes a goal of its own."""

DRIVERS = GHOST, ROUTE, SEQUENCE, TREE
STOPS = (
    'arbiter/stop', 'wheel_kinematics/stop', 'differential_kinematics/stop', 'omni_kinematics/stop',
)  # fmt: skip
"""Services that hold the wheels; those of the kinematics stand in where there is no arbiter."""
