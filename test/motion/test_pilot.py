"""One command of agent and navigator; whoever may move gives way, even while its sap stands."""

from __future__ import annotations

from math import dist

import pytest
from shapely import box

from agv_motion.errors import GeometryError
from agv_motion.motion.behavior.agent import Agent
from agv_motion.motion.behavior.decision import Decision
from agv_motion.motion.behavior.goals.strategies import GoalParameters
from agv_motion.motion.behavior.homing import HomeParameters
from agv_motion.motion.behavior.parameters import AgentParameters
from agv_motion.motion.behavior.sap_flow import SapFlow
from agv_motion.motion.behavior.schedule import ScheduleParameters
from agv_motion.motion.command.polar import to_twist
from agv_motion.motion.navigation.navigator import Guidance
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.motion.navigation.reservations.reservation import MessageId, Reservation
from agv_motion.motion.navigation.reservations.right_of_way import RightOfWay
from agv_motion.motion.navigation.reservations.shared_navigator import SharedNavigator
from agv_motion.motion.navigation.zone import Zone
from agv_motion.motion.pilot import Pilot, motion_command
from agv_motion.planar import Pose, integrate

CORRIDOR = Zone([[0, 0], [30, 0], [30, 2.5], [0, 2.5]], margin=1.0)
TRAFFIC = TrafficParameters(body=0.7, margin=0.2, tolerance=0.2, listen=0.0, silent_after=30.0)
CLEARANCE = 2.0
"""[m] twice 0.7 + 0.2 + 0.2 / 2"""
SPEED = 0.5
RUN = 7
"""of the tree under test"""
ASLEEP = SapFlow(0.0, 0.5, 0.1)
NIGHT = 1434344400.0
"""2015-06-15, 05:00 UTC"""


class Oak:
    """A tree in the corridor; `ash` comes along it, and went first."""

    def __init__(self, place, zone=CORRIDOR, **given):
        planner = PathPlanner(zone)
        self.agent = Agent(planner, AgentParameters(home=HomeParameters(speed=SPEED), **given))
        self.navigator = SharedNavigator(RightOfWay('oak', place, TRAFFIC, RUN), planner)
        self.pilot = Pilot(self.agent, self.navigator)
        self.pose = Pose(*place, 0.0)
        self.going, self.giving_way, self.activities = set(), set(), []

    def live(self, flow, seconds, start=NIGHT):
        """Go on for a while, one decision a second."""
        for now in range(round(start), round(start) + seconds):
            path = (6.0, 1.25), (14.0, 1.25)
            self.navigator.right.receive(
                Reservation(
                    'ash', MessageId(1, now), 0.9, path[:1], (), path, 0,
                    received={'oak': MessageId(RUN, now)}, margin=0.2,
                ), now,
            )  # fmt: skip
            self.navigator.reservation(now)
            motion = self.pilot.update(now, self.pose, flow, now)
            speeds = self.giving_way if 'gives way' in motion.doing.state else self.going
            speeds.add(motion.wanted.v)
            assert motion.path or not motion.wanted.v
            if motion.doing.state not in self.activities[-1:]:
                self.activities.append(motion.doing.state)
            self.pose = integrate(self.pose, to_twist(motion.wanted), 1.0)
        return self

    def gave_way(self):
        return dist((self.pose.x, self.pose.y), (14.0, 1.25)) == pytest.approx(CLEARANCE, abs=0.11)


def test_a_tree_whose_sap_stands_steps_aside_slowly_and_says_so():
    oak = Oak((10.0, 1.25), goals=GoalParameters(strategy='memory')).live(ASLEEP, 1200)
    assert oak.gave_way()
    assert (oak.going, oak.giving_way) == ({0.0}, {SPEED})
    assert 'resting: the sap stands: gives way' in oak.activities
    assert oak.activities[-1] == 'resting: the sap stands'


@pytest.mark.parametrize('s1', [0.1, 0.8])
def test_a_tree_steps_aside_as_its_sap_flows_but_no_slower(s1):
    oak = Oak((8.3, 1.25), goal=(2.0, 1.25)).live(SapFlow(s1, 0.5, 0.9), 1300)
    assert oak.gave_way()
    assert oak.going <= {0.0, s1}
    assert oak.giving_way == {max(s1, SPEED)}


def test_one_that_is_in_nobodys_way_rests_where_it_is():
    oak = Oak((20.0, 1.25)).live(ASLEEP, 300)
    assert (oak.pose.x, oak.pose.y) == (20.0, 1.25)
    assert oak.pilot.update(NIGHT + 300, oak.pose, ASLEEP, NIGHT + 300).path == ()


def test_nobody_steps_aside_before_opening():
    oak = Oak((10.0, 1.25), schedule=ScheduleParameters(enabled=True)).live(ASLEEP, 300)
    assert (oak.pose.x, oak.pose.y) == (10.0, 1.25)
    assert (oak.going, oak.giving_way) == ({0.0}, set())


def test_who_goes_on_to_a_goal_while_its_sap_stands_does_not_hurry_for_others():
    """The least speed is for giving way alone."""
    resting = Decision('resting', None, yield_speed=SPEED)
    for gives_way, speed in ((False, 0.0), (True, SPEED)):
        guidance = Guidance((3.0, 4.0), gives_way=gives_way)
        assert motion_command(resting, guidance, Pose(0.0, 0.0, 0.0)).wanted.v == speed
    assert motion_command(resting, Guidance((3.0, 4.0)), Pose(0.0, 0.0, 0.0)).wanted.v == 0.0


class Barred:
    """A navigator of one whom others have kept from its goal for long, or not."""

    patience = 60.0

    def __init__(self):
        self.blocked, self.asked, self.floor, self.failure = 0.0, 0, None, None

    def navigate(self, goal, here, now, *, straight=False):
        return Guidance(None, (here,), 'waits for ash', self.blocked, failure=self.failure)

    def closed(self):
        self.asked += 1
        return self.floor


@pytest.mark.parametrize('lasting', [False, True])
def test_a_goal_of_its_own_choice_is_given_up_once_the_way_is_barred_for_long(lasting):
    """One that was sent stays; where others are is asked for a new choice alone."""
    chosen = {'goal': (2.0, 1.25)} if lasting else {'goals': GoalParameters(strategy='memory')}
    agent, navigator = Agent(PathPlanner(CORRIDOR), AgentParameters(**chosen)), Barred()
    pilot = Pilot(agent, navigator)

    def goal(blocked):
        navigator.blocked = blocked
        flow = SapFlow(0.8, 0.5, 0.4)
        return pilot.update(NIGHT + blocked, Pose(10.0, 1.25, 0.0), flow, blocked).goal

    first = goal(0.0)
    navigator.floor = box(first.x - 3.0, 0.0, first.x + 3.0, 2.5)
    assert goal(60.0) == goal(60.1) == first
    assert navigator.asked == 0
    after = goal(0.0)
    assert (after == first) is lasting
    assert navigator.asked == (0 if lasting else 1)
    assert lasting or abs(after.x - first.x) > 3.0
    assert goal(0.0) == after


@pytest.mark.parametrize('failure', [None, GeometryError('no path leads there')])
def test_a_goal_to_which_no_path_leads_is_given_up_at_once(failure):
    given = AgentParameters(goals=GoalParameters(strategy='memory'))
    agent, navigator = Agent(PathPlanner(CORRIDOR), given), Barred()
    navigator.failure = failure
    Pilot(agent, navigator).update(NIGHT, Pose(10.0, 1.25, 0.0), SapFlow(0.8, 0.5, 0.4), 0.0)
    assert (agent.goal is None) is (failure is not None)
