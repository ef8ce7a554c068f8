"""The agent in a closed loop with an ideal platform: it reaches, returns, rests, and says why."""

from __future__ import annotations

from math import cos, hypot, inf, pi, sin

import numpy as np
import pytest
import shapely

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.platform import PLATFORM_RADIUS
from agv_motion.motion.behavior.agent import Agent
from agv_motion.motion.behavior.goals.goal import Objective
from agv_motion.motion.behavior.goals.strategies import GoalParameters
from agv_motion.motion.behavior.homing import HomeParameters
from agv_motion.motion.behavior.parameters import AgentParameters
from agv_motion.motion.behavior.sap_flow import SapFlow
from agv_motion.motion.behavior.schedule import ScheduleParameters
from agv_motion.motion.command.polar import STILL, to_twist
from agv_motion.motion.navigation.navigator import StraightNavigator
from agv_motion.motion.navigation.path_follower import PathFollower
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.zone import Zone
from agv_motion.motion.pilot import Pilot
from agv_motion.planar import Pose, integrate
from agv_motion.simulation.trials.season_zones import plan_of

NOON = 1434369600.0
"""2015-06-15, a Monday, 12:00 UTC"""
MEMORY = GoalParameters(strategy='memory')
YARD = Zone([[0, 0], [12, 0], [12, 9], [0, 9]], [[[5, 3], [7, 3], [7, 9], [5, 9]]], home=[2, 7])
"""Two rooms joined in the south."""


class Life:
    """A tree on an ideal platform; s3 grows to the east."""

    def __init__(self, agent, x, y, time=NOON):
        self.agent, self.pose, self.time = agent, Pose(x, y, 0.3), time
        planner = agent.planner
        self.pilot = Pilot(agent, PathFollower(planner) if planner else StraightNavigator())
        self.flow = SapFlow(0.8, 0.6, 0.5)
        self.motion = None
        self.activities = []
        self.goals = []

    def move(self):
        flow = self.flow._replace(s3=min(max(self.pose.x / 12.0, 0.0), 1.0))
        self.motion = self.pilot.update(self.time, self.pose, flow, self.time)
        if not self.activities or self.activities[-1] != self.motion.doing.state:
            self.activities.append(self.motion.doing.state)
        if self.motion.goal is not None and self.motion.goal not in self.goals[-1:]:
            self.goals.append(self.motion.goal)
        return self.motion

    def live(self, seconds, dt=2.0):
        """Go on for a while; the centre never leaves the margin by more than the slack."""
        end = self.time + seconds
        while self.time < end:
            motion = self.move()
            wanted = motion.wanted._replace(v=min(motion.wanted.v, motion.rules.top_speed))
            self.pose = integrate(self.pose, to_twist(wanted), dt)
            self.time += dt
        return self

    @property
    def here(self):
        return self.pose.x, self.pose.y


def agent(zone=YARD, **parameters):
    return Agent(
        None if zone is None else PathPlanner(zone),
        AgentParameters(**({'goals': MEMORY} | parameters)),
    )


def test_it_goes_from_goal_to_goal_round_the_wall_and_never_leaves_the_margin():
    life = Life(agent(), 2.0, 2.0)
    free = YARD.floor.buffer(-0.48 + 1e-3)
    for _ in range(4 * 60):
        life.live(60.0)
        assert free.covers(shapely.Point(life.here))
    assert len(life.goals) > 10
    assert {goal.objective for goal in life.goals} == set(Objective)
    sides = [goal.x > 6.0 for goal in life.goals]
    assert any(sides)
    assert not all(sides)


def test_the_goal_is_reached_within_the_way_over_the_speed():
    life = Life(agent(), 2.0, 2.0)
    first = life.move().goal
    path = shapely.LineString(life.motion.path).length
    life.live((path - 1.0) / 0.8 * 60.0 + 10.0)
    assert life.goals[0] is first
    assert life.move().goal is not first


def test_every_reachable_place_is_visited_in_two_days():
    """96 m2 of floor; sixteen hours at 0.8 m a minute are 768 m of path."""
    life = Life(agent(), 2.0, 2.0)
    life.live(16 * 3600.0, dt=10.0)
    assert life.agent.memory.coverage()[0] == 1.0


def test_what_it_does_is_told_with_the_reason():
    life = Life(agent(), 2.0, 2.0)
    assert life.move().doing.state.startswith('walking to never visited: (')
    life.live(3600.0)
    assert any('walking to highest remembered sap flow 0.' in a for a in life.activities)


def test_nothing_is_remembered_of_its_sleep():
    life = Life(agent(), 2.0, 2.0)
    life.flow = SapFlow(0.0, 0.0, 0.0)
    life.pose = Pose(0.6, 2.0, 0.0)
    assert life.move().doing.state == 'resting: the sap stands'
    assert life.motion.wanted == STILL
    assert not life.agent.memory.visited.any()


def test_turning_is_not_allowed_where_part_of_the_platform_is_on_delicate_floor():
    zone = Zone(
        [[0, 0], [20, 0], [20, 9], [0, 9]], translation_only=[[[0, 0], [4, 0], [4, 9], [0, 9]]]
    )
    life = Life(agent(zone), 5.0, 5.0)
    assert not life.move().rules.may_turn
    life.pose = Pose(5.2, 5.0, 0.0)
    assert life.move().rules.may_turn


# What others allow


def test_a_goal_is_chosen_off_what_others_close_and_only_while_they_do():
    tree, closed = agent(), shapely.box(7.0, 0.0, 12.0, 9.0)
    flow, chosen, free = SapFlow(0.8, 0.6, 0.5), [], []
    for goals, area in ((chosen, closed), (free, None)):
        for _ in range(30):
            goals.append(tree.decide(NOON, Pose(2.0, 2.0, 0.0), flow, area).goal)
            assert tree.give_up(goals[-1])
    assert all(goal.x < 7.0 for goal in chosen)
    assert any(goal.x > 7.0 for goal in free)


def test_a_goal_to_which_no_path_leads_is_given_up_for_another():
    parted = Zone([[0, 0], [12, 0], [12, 9], [0, 9]], [[[5, 0], [7, 0], [7, 9], [5, 9]]])
    life = Life(agent(parted), 2.0, 2.0)
    life.agent.set_goal(10.0, 7.0, 'asked for')
    stopped = life.move()
    assert stopped.doing.state.startswith('stopped: goal (10.00, 7.00) lies in another part')
    assert (stopped.wanted, stopped.path) == (STILL, ())
    assert life.move().goal.x < 5.0


def test_a_goal_that_lasts_or_was_replaced_is_not_given_up():
    fixed = agent(goals=GoalParameters(), goal=(10.0, 2.0))
    assert not fixed.give_up(fixed.goal)
    assert fixed.goal.place == (10.0, 2.0)
    tree = agent()
    old = tree.decide(NOON, Pose(2.0, 2.0, 0.0), SapFlow(0.8, 0.6, 0.5)).goal
    tree.set_goal(10.0, 7.0, 'asked for')
    assert not tree.give_up(old)
    assert tree.goal.place == (10.0, 7.0)


def test_giving_up_a_goal_does_not_call_it_back_from_its_way_home():
    tree = agent()
    goal = tree.decide(NOON, Pose(8.0, 2.0, 0.0), SapFlow(0.8, 0.6, 0.5)).goal
    tree.go_home()
    assert tree.give_up(goal)
    decision = tree.decide(NOON, Pose(8.0, 2.0, 0.0), SapFlow(0.8, 0.6, 0.5))
    assert decision.state == 'walking to home at (2.0, 7.0), asked to'


def test_without_any_goal_it_turns_on_the_spot_and_tries_again_after_ten_seconds():
    tree, flow, pose = agent(), SapFlow(0.8, 0.6, 0.5), Pose(2.0, 2.0, 0.0)
    around = YARD.floor.buffer(1.0).difference(shapely.box(1.9, 1.9, 2.1, 2.1))
    first = tree.decide(NOON, pose, flow, around)
    assert first.state == 'no goal can be reached: turning on the spot'
    assert (first.destination, first.rotation) == (None, pytest.approx(2.0 * 0.6 - 1.0))
    assert 'where another tree is' in tree.refusals[0]
    assert tree.decide(NOON + 9.0, pose, flow).goal is None
    assert tree.decide(NOON + 10.0, pose, flow).goal is not None


def test_a_clock_that_is_set_back_does_not_keep_it_from_trying_again():
    tree, flow, pose = agent(), SapFlow(0.8, 0.6, 0.5), Pose(2.0, 2.0, 0.0)
    around = YARD.floor.buffer(1.0).difference(shapely.box(1.9, 1.9, 2.1, 2.1))
    assert tree.decide(NOON, pose, flow, around).goal is None
    assert tree.decide(NOON - 3600.0, pose, flow).goal is not None


# From outside


def test_a_goal_asked_for_is_reached_and_then_the_cycle_goes_on():
    life = Life(agent(), 2.0, 2.0)
    life.live(60.0)
    life.agent.set_goal(10.0, 7.0, 'asked for')
    assert life.move().goal.reason == '(10.0, 7.0), asked for'
    while life.motion.goal.objective is None:
        life.live(10.0)
    assert hypot(life.pose.x - 10.0, life.pose.y - 7.0) < 1.2


def test_the_next_goal_is_another():
    life = Life(agent(), 2.0, 2.0)
    first = life.move().goal
    life.agent.next_goal()
    assert life.move().goal is not first


def test_a_fixed_goal_is_kept_and_noise_there_does_not_send_it_to_and_fro():
    life = Life(agent(goals=GoalParameters(), goal=(10.0, 2.0)), 2.0, 2.0)
    life.live(900.0)
    seen = []
    for x in (8.9, 9.1, 8.9, 8.1, 7.9, 8.1):
        life.pose = Pose(x, 2.0, 0.0)
        seen.append(life.move().doing.state.split()[0])
    assert seen == ['turning', 'turning', 'turning', 'turning', 'walking', 'walking']
    with pytest.raises(ConfigurationError, match='one goal'):
        life.agent.next_goal()


# Home and hours


def test_a_fixed_goal_is_gone_to_again_after_home():
    life = Life(agent(goals=GoalParameters(), goal=(10.0, 2.0)), 2.0, 2.0)
    life.agent.go_home()
    assert life.move().doing.state.startswith('walking to home')
    life.agent.next_goal()
    assert life.move().doing.state.startswith('walking to (10.0, 2.0)')


def test_it_goes_home_when_asked_and_stays():
    life = Life(agent(), 10.0, 7.0)
    life.agent.go_home()
    life.live(3600.0)
    assert life.motion.doing.state == 'at home: asked to'
    assert hypot(life.pose.x - 2.0, life.pose.y - 7.0) < 0.3
    assert life.motion.wanted == STILL
    life.agent.next_goal()
    assert life.move().doing.state.startswith('walking')


def test_it_is_home_before_closing_even_if_little_sap_flows():
    """14:00 UTC; the far corner is 17 m of path from home, 34 min at half speed."""
    hours = ScheduleParameters(enabled=True, closes='14:00')
    life = Life(agent(schedule=hours), 10.0, 8.0, NOON - 3600.0)
    life.flow = SapFlow(0.3, 0.5, 0.5)
    life.live(3 * 3600.0 - 1.0, dt=5.0)
    assert life.motion.doing.state == 'at home: closing at Mon 14:00'
    life.live(10.0)
    assert life.motion.doing.state == 'resting: closed until Tue 10:00'
    life.time = NOON + 22 * 3600.0
    assert life.move().doing.state.startswith('walking to')


def test_it_rests_while_the_probes_calibrate():
    hours = ScheduleParameters(enabled=True, opens='00:00', closes='23:59')
    life = Life(agent(schedule=hours), 2.0, 2.0, NOON - 7 * 3600.0)
    assert life.move().doing.state == 'resting: the probes calibrate until Mon 07:00'
    assert life.motion.wanted == STILL


def test_without_a_home_nobody_goes_there():
    homeless = agent(Zone([[0, 0], [9, 0], [9, 9], [0, 9]]))
    with pytest.raises(ConfigurationError, match='no home'):
        homeless.go_home()


# Outside the zone


def test_outside_it_refuses_and_says_where_it_is():
    life = Life(agent(), -0.5, 2.0)
    assert 'lies outside the zone' in life.move().doing.state
    assert life.motion.wanted == STILL


def test_outside_it_returns_slowly_without_turning_where_that_is_wanted():
    life = Life(agent(home=HomeParameters(outside='return', return_speed=0.2)), -0.5, 2.0)
    motion = life.move()
    assert motion.doing.state.startswith('returning slowly to the zone: the tree lies outside')
    assert (motion.wanted.omega, motion.rules.top_speed) == (0.0, 0.2)
    assert motion.path[1] == pytest.approx((0.5, 2.0))
    life.live(60.0 * 0.5 / 0.2 + 4.0)
    assert YARD.contains(*life.here)
    assert life.move().doing.state.startswith('walking')


def test_a_return_through_a_hole_is_refused():
    zone = Zone([[0, 0], [9, 0], [9, 9], [0, 9]], [[[0.2, 1], [0.4, 1], [0.4, 8], [0.2, 8]]])
    life = Life(agent(zone, home=HomeParameters(outside='return')), -0.5, 4.0)
    assert 'no straight way leads back' in life.move().doing.state


def test_a_strategy_that_remembers_needs_a_zone():
    with pytest.raises(ConfigurationError, match='give zone_file'):
        agent(None)


def test_in_a_changed_zone_it_goes_on_with_what_is_still_there():
    before = agent()
    life = Life(before, 2.0, 2.0).live(60.0)
    after = before.moved_to(PathPlanner(Zone([[0, 0], [14, 0], [14, 9], [0, 9]], home=[2, 7])))
    assert after.goal == before.goal
    assert after.memory.felt.sum() == before.memory.felt.sum() > 0
    before.go_home()
    there = Life(before.moved_to(PathPlanner(YARD)), *life.here, life.time)
    assert there.move().doing.state.startswith('walking to home')
    elsewhere = Zone([[30, 0], [44, 0], [44, 9], [30, 9]])
    assert before.moved_to(PathPlanner(elsewhere)).goal is None


def test_one_that_knew_of_no_zone_begins_to_remember_in_its_first():
    before = agent(zone=None, goals=GoalParameters(), goal=(10.0, 2.0))
    assert before.memory is None
    after = before.moved_to(PathPlanner(YARD))
    assert after.goal == before.goal
    assert not after.memory.felt.any()


def test_before_its_first_goal_it_moves_into_another_zone_without_one():
    before = agent()
    assert before.goal is None
    assert before.moved_to(PathPlanner(YARD)).goal is None


def test_the_same_life_twice():
    """Deterministic: the same seed and the same senses give the same decisions."""
    lives = [Life(agent(), 2.0, 2.0).live(1800.0) for _ in range(2)]
    assert lives[0].goals == lives[1].goals
    assert lives[0].pose == lives[1].pose


def test_noise_of_the_fixes_does_not_keep_it_from_its_goal():
    """Fixes off by up to 20 cm, a different path each time."""
    life = Life(agent(), 2.0, 2.0)
    true, reached = life.pose, 0
    for k in range(1800):
        life.pose = Pose(true.x + 0.2 * sin(7.1 * k), true.y + 0.2 * cos(5.3 * k), true.theta)
        before = life.agent.goal
        motion = life.move()
        reached += motion.goal is not before
        true = integrate(true, to_twist(motion.wanted), 4.0)
        life.time += 4.0
        assert YARD.contains(true.x, true.y)
    assert reached > 3
    assert -pi <= true.theta < pi


@pytest.mark.parametrize('seed', [10, 16])
def test_through_a_narrow_door_with_noisy_fixes_no_rim_touches_a_wall(seed):
    """A door of platform width plus 20 cm, fixes off by up to 12 cm, and neither is too late."""
    chance, zone = np.random.default_rng(seed), plan_of('rooms', seed).zone()
    life = Life(agent(zone=zone), 2.5, 3.5)
    life.flow = SapFlow(1.0, 0.5, 0.5)
    true, error, least = life.pose, (0.0, 0.0), inf
    for goal in ((12.5, 3.5), (2.5, 3.5)):
        life.agent.set_goal(*goal, 'on the other side')
        asked, begun = life.agent.goal, life.time
        while life.agent.goal is asked:
            error = tuple(0.6 * e + float(chance.normal(0.0, 0.032)) for e in error)
            share = min(0.12 / max(hypot(*error), 0.12), 1.0)
            life.pose = Pose(true.x + share * error[0], true.y + share * error[1], true.theta)
            true = integrate(true, to_twist(life.move().wanted), 0.5)
            life.time += 0.5
            edge = zone.floor.boundary.distance(shapely.Point(true.x, true.y))
            least = min(least, edge)
        assert life.time - begun < 900.0
    assert least > PLATFORM_RADIUS
