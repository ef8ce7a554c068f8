"""What others need of the floor, as one tree sees it."""

from __future__ import annotations

from math import inf

import pytest

from agv_motion.motion.navigation.reservations.needs import Needs
from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.motion.navigation.reservations.reservation import IDLE, MessageId, Reservation
from agv_motion.motion.navigation.reservations.right_of_way import RightOfWay

GIVEN = TrafficParameters(body=0.7, margin=0.2, tolerance=0.2, listen=0.0)
CLEARANCE = 2.0
PLANNED = ((6.0, 0.0), (16.0, 0.0))


@pytest.fixture
def right():
    return RightOfWay('oak', (0.0, 0.0), GIVEN, 7)


def hear_ash(right, journey, *, requested=()):
    ash = Reservation(
        'ash', MessageId(1, 1), 0.9, ((6.0, 0.0),), requested, PLANNED, journey, margin=0.2
    )
    right.receive(ash, 0.0)
    return Needs(right)


def test_the_next_metres_of_who_goes_first_are_left_and_of_no_other(right):
    right.set_out()
    assert len(hear_ash(right, journey=2).of_all()) == 1
    first = hear_ash(RightOfWay('oak', (0.0, 0.0), GIVEN, 7), journey=2)
    held, planned = first.of_all()
    assert (held.clearance, planned.clearance) == pytest.approx((CLEARANCE, CLEARANCE))
    assert planned.path.length == 4.0
    assert len(first.of_all(plans=False)) == 1
    first.courtesy = inf
    assert first.of_all()[1].path.length == 10.0


def test_one_that_requests_floor_is_no_standing_one(right):
    needs = hear_ash(right, 2, requested=((6.0, 0.0), (7.0, 0.0)))
    assert needs.of_all(standing=True) == []
    assert len(needs.of_all()) == 3  # where it is, what it requests, and what it plans


def test_a_piece_is_cut_where_it_comes_nearer_than_the_clearance(right):
    free = hear_ash(right, journey=2).leave(((0.0, 0.0), (5.0, 0.0)), 0.05, plans=True)
    assert free.by == 'ash'
    assert free.path[-1] == pytest.approx((4.0, 0.0), abs=0.06)


def test_the_last_guard_spares_half_the_tolerance(right):
    needs = hear_ash(right, journey=2)
    assert needs.step(((0.0, 0.0), (4.05, 0.0)), 0.1).by == ''
    assert needs.step(((0.0, 0.0), (4.2, 0.0)), 0.1).by == 'ash'


def test_plans_of_who_goes_first_are_widened(right):
    (plan,) = hear_ash(right, journey=2).plans(3.0, 0.1)
    assert (plan.path.length, plan.clearance) == (3.0, pytest.approx(CLEARANCE + 0.1))


def test_plans_of_who_goes_later_are_not_counted(right):
    right.set_out()
    assert hear_ash(right, journey=2).plans(3.0, 0.1) == []


def test_of_those_who_set_out_later_the_last_counts(right):
    """By the clock here: the rowan was first heard of 5 s after the ash."""
    right.set_out(IDLE - 2)
    assert Needs(right).last_begun() is None
    for name, journey, now in (
        ('ash', IDLE - 1, 10.0),
        ('rowan', IDLE - 1, 15.0),
        ('elm', 1, 20.0),
    ):
        where = ((6.0, 0.0),)
        heard = Reservation(name, MessageId(1, 1), 0.9, where, journey=journey, margin=0.2)
        right.receive(heard, now)
    assert Needs(right).last_begun() == 15.0
