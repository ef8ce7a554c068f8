"""Numbers of this room: what nobody told is nothing, a number changes on purpose only."""

from __future__ import annotations

from room_numbers import constants, defaults

CONSTANTS = {
    'approach.AVERAGED': 1.0 / 3.0,
    'approach.NEARER': 0.9,
    'arc.DIAMETERS': (0.0, 1e9),
    'arc.MOST_ANGLE': 1e9,
    'arc.TRACKS': (1e-6, 1e9),
    'arc_length.CHANGE_IN_A_CELL': 0.05,
    'arc_length.FEWEST_FIRST': 8,
    'arc_length.FIRST_CELLS': 64,
    'arc_length.FIRST_CELLS_IN_ALL': 512,
    'arc_length.LEAST': 1e-15,
    'arc_length.MOST_CELLS': 4000,
    'arc_length.MOST_CELLS_IN_ALL': 20_000,
    'arc_length.MOST_PARTS': 8,
    'arc_length.MOST_TURN': 1_000_000.0,
    'arc_run.SMALLEST': 1e-12,
    'bounds.AT_ONCE': 1e300,
    'bounds.NO_RAMP': 0.0,
    'bounds.RAMPS': (1e-9, 1e300),
    'bounds.SPEEDS': (1e-9, 1_000_000.0),
    'curve_ceiling.SHORTEST': 1e-12,
    'departure.AT_ONCE': (0.0,),
    'departure.DEPARTURES': (0.0, 0.25, 0.5, 0.75, 0.9),
    'feasibility.MOST_LINES': 10,
    'feasibility.STRAIGHT': 0.001,
    'follower.CORRECTION_RAMPS': 0.2,
    'follower.CORRECTION_SPEED': 0.1,
    'ghost.MANY': 100,
    'limits.STRAIGHT': 1e-12,
    'motion.STILL': (0.0, 0.0),
    'pace.SLOWEST': 0.1,
    'path_headings.APART': 1e-6,
    'planner.MOST_MOTIONS': 400,
    'planner.NOTHING': 1e-9,
    'speed_plan.ROUNDING': 1e-15,
    'trapezoidal.DISTANCES': (0.0, 1e9),
    'trapezoidal.ROUNDINGS': (0.0, 1_000_000.0),
}

DEFAULTS = {
    'departure.leave': {'departures': (0.0, 0.25, 0.5, 0.75, 0.9)},
    'follower_parameters.FollowerParameters': {
        'delay': 0.03, 'tolerance': 0.03, 'heading_tolerance': 0.06, 'settle_speed': 0.02,
        'settle_turn': 0.04, 'settle_time': 1.0, 'corrections': 2,
    },
    'ghost.Ghost._depart': {'departures': (0.0, 0.25, 0.5, 0.75, 0.9)},
    'ghost.Ghost.advance': {'rate': 1.0},
    'ghost_parameters.GhostParameters': {
        'track': 0.3, 'wheel_speed': 1.0, 'linear_speed': 100.0, 'turn_rate': 2.0,
        'lateral_acceleration': 0.5, 'turn_acceleration': 2.0, 'turn_step': 0.4,
        'longest_way': 1000.0, 'longest_time': 7200.0, 'most_poses': 1000,
    },
    'holonomic.HolonomicGains': {'position': 4.0, 'heading': 4.0},
    'kanayama.KanayamaGains': {
        'along': 4.0, 'across': 16.0, 'heading': 8.0, 'heading_at_rest': 2.0,
    },
    'pace.PaceParameters': {
        'slow_beyond': 0.1, 'wait_beyond': 0.25, 'lost_beyond': 0.6, 'heading_arm': 0.15,
        'ease': 0.5,
    },
    'planner.Planner.arc': {'present': (0.0, 0.0)},
    'planner.Planner.drive': {'present': (0.0, 0.0)},
    'planner.Planner.rotation': {'present': (0.0, 0.0)},
    'planner.Planner.turn': {'present': (0.0, 0.0)},
    'ramsete.RamseteGains': {'b': 16.0, 'zeta': 0.9, 'at_rest': 2.0},
}  # fmt: skip


def test_numbers_change_on_purpose_only():
    assert constants('trajectory') == CONSTANTS


def test_what_nobody_told_is_nothing_or_in_a_table():
    assert defaults('trajectory') == DEFAULTS
