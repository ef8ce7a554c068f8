"""Which path a tree takes among others, when it waits, and when it gives way."""

from __future__ import annotations

from itertools import pairwise
from math import dist

import pytest

from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.motion.navigation.reservations.reservation import IDLE, MessageId, Reservation
from agv_motion.motion.navigation.reservations.right_of_way import RightOfWay
from agv_motion.motion.navigation.reservations.shared_navigator import STUCK, SharedNavigator
from agv_motion.motion.navigation.zone import Zone

PARAMETERS = TrafficParameters(body=0.7, margin=0.2, tolerance=0.2, listen=0.0, silent_after=30.0)
CLEARANCE = 2.0
"""[m] twice 0.7 + 0.2 + 0.2 / 2"""
HALL = Zone([[0, 0], [30, 0], [30, 20], [0, 20]], margin=1.0)
CORRIDOR = Zone([[0, 0], [30, 0], [30, 2.5], [0, 2.5]], margin=1.0)


RUN = 7
"""of the tree under test"""


def tree(name, x, y, zone=HALL, **changes):
    given = TrafficParameters(**(PARAMETERS.__dict__ | changes))
    return SharedNavigator(RightOfWay(name, (x, y), given, RUN), PathPlanner(zone))


def other(now, *held, **rest):
    """Return what `ash` says, which has heard all there is to hear."""
    message_id, received = MessageId(1, round(now)), {'oak': MessageId(RUN, 10**9)}
    return Reservation('ash', message_id, 0.9, held, received=received, margin=0.2, **rest)


def walk(oak, goal, seconds, ash=lambda now: None, start=0):
    """Let a tree walk 5 cm a second, and hear what ``ash`` says; return where it comes by."""
    place = oak.right.held[0]
    places = [place]
    for now in range(start, start + seconds):
        message_id = ash(now)
        if message_id is not None:
            oak.right.receive(message_id, now)
        oak.reservation(now)
        target = oak.navigate(goal, place, now).target
        if target is not None and (away := dist(place, target)) > 0.0:
            share = min(0.05 / away, 1.0)
            place = tuple(p + share * (t - p) for p, t in zip(place, target, strict=True))
        places.append(place)
    return places


def test_alone_it_walks_straight_to_its_goal():
    places = walk(tree('oak', 2.0, 5.0), (10.0, 5.0), 200)
    assert places[-1] == pytest.approx((10.0, 5.0), abs=0.06)
    assert all(y == pytest.approx(5.0) for _, y in places)


def test_it_goes_round_one_that_stands_in_its_way():
    ash = (6.0, 5.0)
    places = walk(tree('oak', 2.0, 5.0), (10.0, 5.0), 400, ash=lambda now: other(now, ash))
    assert places[-1] == pytest.approx((10.0, 5.0), abs=0.06)
    assert min(dist(place, ash) for place in places) >= CLEARANCE - PARAMETERS.tolerance
    assert sum(dist(a, b) for a, b in pairwise(places)) < 11.0


def test_the_first_path_leads_round_one_that_stands_there_but_not_round_one_that_walks():
    """Whoever walks will be gone; a third tree, far away, changes nothing."""
    start, goal, place = (2.0, 5.0), (10.0, 5.0), (6.0, 5.0)
    elm = Reservation('elm', MessageId(2, 0), 0.9, ((25.0, 15.0),), margin=0.2)
    for asked, is_straight in (((), False), ((place, (6.0, 8.0)), True)):
        oak = tree('oak', *start)
        oak.right.receive(other(0, place, requested=asked, journey=2), 0)
        oak.right.receive(elm, 0)
        path = oak.navigate(goal, start, 0).path
        assert path[-1] == pytest.approx(goal)
        length = sum(dist(a, b) for a, b in pairwise(path))
        assert (length == pytest.approx(8.0)) is is_straight


def test_in_a_corridor_it_waits_and_says_for_whom():
    oak = tree('oak', 2.0, 1.25, CORRIDOR)
    places = walk(oak, (20.0, 1.25), 300, ash=lambda now: other(now, (10.0, 1.25)))
    assert dist(places[-1], (10.0, 1.25)) >= CLEARANCE
    passage = oak.navigate((20.0, 1.25), places[-1], 300.0)
    assert passage.target is None
    assert passage.reason == 'waits for ash'
    assert passage.blocked > 100.0


@pytest.mark.parametrize('silent', [False, True])
def test_courtesy_leaves_the_way_to_who_goes_first_while_it_speaks(silent):
    """A tree that fell silent may never walk the path that it meant to go."""

    def ash(now):
        if silent and now > 10:
            return None
        return other(now, (6.0, 10.0), journey=0, planned=((6.0, 10.0), (6.0, 5.0)))

    places = walk(tree('oak', 2.0, 5.0), (6.0, 5.0), 500, ash)
    assert (dist(places[-1], (6.0, 5.0)) < 0.1) is silent


def test_who_stands_in_the_way_of_one_that_goes_first_walks_out_of_it():
    """In the corridor the only refuge lies behind, beyond where the other goes; there it waits."""

    def ash(now):
        return other(now, (6.0, 1.25), journey=0, planned=((6.0, 1.25), (14.0, 1.25)))

    places = walk(tree('oak', 10.0, 1.25, CORRIDOR), (2.0, 1.25), 600, ash)
    assert places[-1][0] == pytest.approx(14.0 + CLEARANCE, abs=0.11)


def test_who_goes_first_but_is_blocked_for_long_becomes_the_youngest():
    """The other found no refuge: let this one look for one."""
    oak = tree('oak', 10.0, 1.25, CORRIDOR)

    def ash(now):
        journey = 2 if now else IDLE  # it sets out once oak has
        return other(now, (6.0, 1.25), journey=journey, planned=((6.0, 1.25), (14.0, 1.25)))

    places = walk(oak, (2.0, 1.25), 250, ash)
    assert oak.right.journey == 1
    assert places[-1][0] == pytest.approx(8.0, abs=0.1)
    places = walk(oak, (2.0, 1.25), 600, ash, start=250)
    assert oak.right.journey > 2
    assert places[-1][0] == pytest.approx(14.0 + CLEARANCE, abs=0.11)


def test_whatever_was_granted_no_step_leads_onto_floor_that_another_holds_now():
    """Ash is carried onto the path that oak holds: oak stops clear of it, and says for whom."""
    oak, goal = tree('oak', 2.0, 5.0), (12.0, 5.0)
    x, y = place = walk(oak, goal, 20)[-1]
    assert oak.right.held[-1][0] > x + 0.1
    oak.right.receive(other(20, (x + 1.95, y)), 20)
    target = oak.navigate(goal, place, 20).target
    assert target == pytest.approx((x + 0.05, y), abs=0.03), 'half the tolerance nearer than 2 m'
    oak.right.receive(other(21, (x + 1.5, y)), 21)
    passage = oak.navigate(goal, place, 21)
    assert passage.target is None
    assert passage.reason == 'waits for ash, which is on its floor'
    assert len(oak.right.held) == 1


def test_a_tree_that_was_carried_tells_where_it_is_and_stands_until_others_have_heard():
    oak = tree('oak', 2.0, 5.0)
    walk(oak, (10.0, 5.0), 20)
    passage = oak.navigate((10.0, 5.0), (4.0, 8.0), 20.0)
    assert passage.target is None
    assert 'off its way, more than the tolerance of 0.2 m' in passage.reason
    assert oak.reservation(20.0).held[0] == (4.0, 8.0)
    places = walk(oak, (10.0, 5.0), 31, start=20)
    assert places[-1] == (4.0, 8.0)
    places = walk(oak, (10.0, 5.0), 300, start=51)
    assert places[-1] == pytest.approx((10.0, 5.0), abs=0.06)


def test_nobody_walks_onto_the_floor_of_one_whose_fix_comes_and_goes():
    """Ash stands in oak's path, and believes for 25 of 30 seconds to be far away."""
    oak, ash = tree('oak', 2.0, 1.25, CORRIDOR), tree('ash', 6.0, 1.25, CORRIDOR)
    place = (2.0, 1.25)
    for now in range(400):
        wrong = now > 5 and now % 30 < 25
        ash.rest((20.0, 1.25) if wrong else (6.0, 1.25), now)
        messages = oak.reservation(now), ash.reservation(now)
        oak.right.receive(messages[1], now)
        ash.right.receive(messages[0], now)
        target = oak.navigate((12.0, 1.25), place, now).target
        if target is not None and (away := dist(place, target)) > 0.0:
            share = min(0.05 / away, 1.0)
            place = tuple(p + share * (t - p) for p, t in zip(place, target, strict=True))
        assert 6.0 - place[0] >= 2 * 0.7 + 0.2


def test_a_fix_that_was_wrong_once_costs_time_and_no_more():
    oak = tree('oak', 2.0, 5.0)
    place = walk(oak, (10.0, 5.0), 20)[-1]
    for now in range(20, 25):
        passage = oak.navigate((10.0, 5.0), (15.0, 9.0), now)
        assert passage.target is None
    assert oak.right.reservation(25).held == ((15.0, 9.0), *oak.right.doubt.before)
    oak.navigate((10.0, 5.0), place, 25)
    places = [place]
    for now in range(26, 300):
        oak.reservation(now)
        target = oak.navigate((10.0, 5.0), places[-1], now).target
        assert target is None or now > 55
        if target is not None and (away := dist(places[-1], target)) > 0.0:
            share = min(0.05 / away, 1.0)
            places.append(
                tuple(p + share * (t - p) for p, t in zip(places[-1], target, strict=True))
            )
    assert places[-1] == pytest.approx((10.0, 5.0), abs=0.06)


def test_a_request_is_never_taken_back_because_the_answer_is_slow():
    """An answer takes 10 minutes; the tree asks for the same all the time, and is not blocked."""
    oak = tree('oak', 2.0, 5.0)
    asked = set()
    for now in range(600):
        oak.right.receive(
            Reservation('ash', MessageId(1, now), 0.9, ((20.0, 15.0),), margin=0.2), now
        )
        oak.reservation(now)
        passage = oak.navigate((10.0, 5.0), (2.0, 5.0), now)
        asked.add(oak.right.requested)
        assert passage.blocked < STUCK
        assert passage.reason == 'waits for the answer of ash'
    assert len(asked) == 1
    oak.right.receive(other(600, (20.0, 15.0)), 600)
    assert oak.navigate((10.0, 5.0), (2.0, 5.0), 600).target is not None


@pytest.mark.parametrize('tolerance', [0.02, 0.1, 0.3])
def test_corners_are_cut_by_no_more_than_half_the_tolerance(tolerance):
    """Round a tree that stands in the way there are corners everywhere."""
    oak, ash = tree('oak', 2.0, 5.0, tolerance=tolerance), (6.0, 5.0)
    places = walk(oak, (10.0, 5.0), 600, ash=lambda now: other(now, ash))
    assert places[-1] == pytest.approx((10.0, 5.0), abs=0.06)
    assert oak.right.obstacle(600.0) == ''
    clearance = 0.7 + tolerance + 0.9 + 0.2
    assert min(dist(place, ash) for place in places) >= clearance - tolerance / 2.0


T = Zone([[0, 6], [0, 9], [20, 9], [20, 6], [11.5, 6], [11.5, 0], [8.5, 0], [8.5, 6]], margin=1.0)


WEST, EAST, SOUTH = (2.0, 7.5), (18.0, 7.5), (10.0, 1.5)


@pytest.mark.parametrize('starts', [(WEST, EAST), (WEST, SOUTH), (SOUTH, EAST)])
def test_two_with_fixed_goals_in_a_t_both_get_there(starts):
    """Each goes where the other starts: one steps into the third arm. Mirrored it is the same."""
    oak, ash = (tree(name, *at, T) for name, at in zip(('oak', 'ash'), starts, strict=True))
    trees = {oak: starts[0], ash: starts[1]}
    goals = {oak: starts[1], ash: starts[0]}
    reached = set()
    for now in range(3000):
        messages = {one: one.reservation(now) for one in trees}
        for one, place in trees.items():
            one.right.receive(messages[ash if one is oak else oak], now)
            target = one.navigate(goals[one], place, now).target
            if target is not None and (away := dist(place, target)) > 0.0:
                share = min(0.05 / away, 1.0)
                trees[one] = tuple(p + share * (t - p) for p, t in zip(place, target, strict=True))
            if dist(trees[one], goals[one]) < 0.3:
                reached.add(one)
        assert dist(*trees.values()) >= 2 * 0.7 + 0.2
        if len(reached) == 2:
            return
    pytest.fail(f'{[one.right.name for one in trees if one not in reached]} never got there')


def test_who_goes_first_waits_from_when_it_heard_of_the_other_journey_whatever_clocks_say():
    """Ash stood there idle and sets out after 200 s: from then on it has twice the patience."""
    oak = tree('oak', 10.0, 1.25, CORRIDOR)

    def ash(now):
        journey = 2 if now >= 10_200 else IDLE
        return other(now, (6.0, 1.25), journey=journey, planned=((6.0, 1.25), (14.0, 1.25)))

    walk(oak, (2.0, 1.25), 430, ash, start=10_000)
    assert oak.right.journey == 1
    walk(oak, (2.0, 1.25), 20, ash, start=10_430)
    assert oak.right.journey > 2
