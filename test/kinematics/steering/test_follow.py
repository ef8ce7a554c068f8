"""How much of a change all turrets can follow, and the quick answer where it is all of it."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.kinematics.steering import AtRest, Rolling, SteeringLimits, SteeringPlanner
from agv_motion.kinematics.steering.chassis import measure
from agv_motion.kinematics.steering.follow import all_follow, longest_share
from agv_motion.kinematics.turrets import Turrets
from agv_motion.planar import Twist

CORNERS = Turrets([(cos(a), sin(a)) for a in (-pi / 3, pi / 3, pi)])
LIMITS = SteeringLimits()


@settings(max_examples=100)
@given(st.integers(0, 10**6))
def test_all_follow_just_where_the_longest_share_is_the_whole(seed):
    chance = np.random.default_rng(seed)
    planner, phase = SteeringPlanner(CORNERS, LIMITS), AtRest.at([0.0] * 3)
    chassis = measure(CORNERS, LIMITS)
    heading, spin = chance.uniform(-pi, pi), 0.0
    for _ in range(150):
        heading, spin = heading + chance.normal(0.0, 0.03), spin + chance.normal(0.0, 2e-4)
        phase = planner.step(phase, Twist(0.01 * cos(heading), 0.01 * sin(heading), spin), 0.1)
        if not isinstance(phase, Rolling):
            continue
        size = 10.0 ** chance.uniform(-3.0, 0.0)
        target = tuple(size * chance.uniform(-1.0, 1.0) for _ in range(3))
        share = longest_share(chassis, phase, target, 0.1)
        assert all_follow(chassis, phase, target, 0.1) == (share == 1.0)
