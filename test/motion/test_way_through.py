"""How many files the data pass on their way; whoever looks for a fault has to read no more."""

from __future__ import annotations

import sys

from agv_motion.motion.behavior import Agent, AgentParameters, GoalParameters, SapFlow
from agv_motion.motion.command import CommandLimits, LimitParameters, to_twist
from agv_motion.motion.navigation import PathFollower, PathPlanner, Zone
from agv_motion.motion.navigation.reservations import (
    RightOfWay,
    SharedNavigator,
    TrafficParameters,
)
from agv_motion.motion.navigation.reservations.reservation import MessageId, Reservation
from agv_motion.motion.pilot import Pilot
from agv_motion.planar import Pose

ZONE = Zone([[0, 0], [20, 0], [20, 15], [0, 15]], [[[8, 5], [12, 5], [12, 9], [8, 9]]], home=[2, 2])
NOON = 1434369600.0
FLOW = SapFlow(0.8, 0.6, 0.4)
VALUES = {'cells', 'goal', 'planar', 'polyline', 'sap_flow', 'separation', 'zone'}
"""They answer what is asked of points, lines, cells and values, and decide nothing."""


def passed(act):
    """Return the files in which ``act`` calls a function, and the calls."""
    files, calls = set(), 0

    def note(frame, event, _argument):
        nonlocal calls
        if event == 'call' and '/agv_motion/' in frame.f_code.co_filename:
            files.add(frame.f_code.co_filename.rsplit('/', 1)[1].removesuffix('.py'))
            calls += 1

    sys.setprofile(note)
    try:
        act()
    finally:
        sys.setprofile(None)
    return files - VALUES, calls


def test_flow_and_pose_pass_seven_files_to_the_twist_and_the_node_is_the_eighth():
    planner = PathPlanner(ZONE)
    given = AgentParameters(goals=GoalParameters(strategy='memory'))
    pilot, limits = Pilot(Agent(planner, given), PathFollower(planner)), CommandLimits.of(LIMITS)

    def tick(x):
        motion = pilot.update(NOON + x, Pose(x, 3.0, 0.1), FLOW, x)
        to_twist(limits.apply(motion.wanted, motion.rules, 0.1).command)

    tick(3.0)
    files, calls = passed(lambda: tick(3.01))
    assert files == {'pilot', 'agent', 'ground', 'memory', 'path_follower', 'limits', 'polar'}
    assert calls < 50


LIMITS = LimitParameters()


def test_a_reservation_passes_six_files_to_the_floor_and_two_more_from_the_topic():
    """The other two are the exchange of the node, and the reading of its message."""
    right = RightOfWay('oak', (3.0, 3.0), TrafficParameters(listen=0.0), 7)
    navigator, goal, here = SharedNavigator(right, PathPlanner(ZONE)), (5.0, 13.0), (3.0, 3.0)
    for now in (1.0, 1.1):
        navigator.navigate(goal, here, now)
        hears = {'oak': MessageId(7, navigator.reservation(now).message_id.number)}
        ash = Reservation(
            'ash', MessageId(1, int(10 * now)), 1.5, ((17.0, 12.0),), received=hears, margin=0.2
        )
        if now == 1.0:
            right.receive(Reservation('ash', MessageId(1, 1), 1.5, ((17.0, 12.0),)), now)

    def answered():
        right.receive(ash, 1.2)
        navigator.navigate(goal, here, 1.2)

    files, calls = passed(answered)
    assert len(right.held) > 1
    assert files == {
        'reservation', 'peers', 'right_of_way', 'shared_navigator', 'needs', 'path_follower',
    }  # fmt: skip
    assert calls < 250
