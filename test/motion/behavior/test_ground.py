"""The ground under a tree: asked once a pose, and what to do beyond the edge."""

from __future__ import annotations

from agv_motion.activity import Activity, Cause
from agv_motion.motion.behavior.ground import Ground
from agv_motion.motion.behavior.homing import HomeParameters
from agv_motion.motion.behavior.sap_flow import SapFlow
from agv_motion.motion.navigation.zone import Zone
from agv_motion.planar import Pose

YARD = [(0.0, 0.0), (20.0, 0.0), (20.0, 10.0), (0.0, 10.0)]
AREA = [(8.0, 0.0), (12.0, 0.0), (12.0, 10.0), (8.0, 10.0)]
FLOW = SapFlow(0.6, 0.5, 0.5)


def ground(outside='refuse'):
    zone = Zone(YARD, translation_only=[AREA], margin=0.5, rim=1.0)
    return Ground(zone, 1.0, HomeParameters(outside=outside, return_speed=0.3))


def test_a_tree_is_inside_while_its_rim_is_and_turns_where_no_part_stands_on_delicate_floor():
    found = ground()
    seen = []
    for x in (1.0, 6.99, 7.01, 0.9):
        found.look(Pose(x, 5.0, 0.0))
        seen.append((found.inside, found.rules.may_turn))
    assert seen == [(True, True), (True, True), (True, False), (False, True)]


def test_without_a_zone_all_is_inside():
    found = Ground(None, 1.0, HomeParameters())
    found.look(Pose(1e6, 0.0, 0.0))
    assert found.inside
    assert found.rules.may_turn


def test_outside_it_refuses_to_move_or_returns_slowly_or_rests():
    here = 0.5, 5.0
    refused = ground().leave(here, FLOW, None, asleep=False)
    assert (refused.activity, refused.because) == (Activity.STOPPED, Cause.ZONE)
    assert refused.destination is None
    back = ground('return').leave(here, FLOW, None, asleep=False)
    assert (back.activity, back.because) == (Activity.WALKING, Cause.ZONE)
    assert back.destination == (1.5, 5.0)
    assert (back.speed, back.rules.top_speed, back.straight) == (0.6, 0.3, True)
    asleep = ground('return').leave(here, FLOW, None, asleep=True)
    assert (asleep.activity, asleep.because) == (Activity.RESTING, Cause.SAP)
