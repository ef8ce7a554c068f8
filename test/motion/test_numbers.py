"""Numbers of this room: what nobody told is nothing, a number changes on purpose only."""

from __future__ import annotations

from math import cos, inf, pi

from room_numbers import constants, defaults

CONSTANTS = {
    'behavior.agent.LEAVE': 2.0,
    'behavior.cells.LARGEST': 4_000_000,
    'behavior.decision.NO_RULES': (True, 1.0),
    'behavior.homing.LOOK_PERIOD': 60.0,
    'behavior.homing.REST_OF_WAY': 1.25,
    'behavior.memory.CLOCK_STEP': 1.0,
    'behavior.memory.NEVER': -inf,
    'behavior.memory_file.COMPRESSIONS': (0, 8),
    'behavior.memory_file.HEADER': 16_384,
    'behavior.memory_file.VERSION': 1,
    'behavior.schedule.DAY': 86_400.0,
    'command.limits.ROUNDING': 1e-12,
    'command.limits.STOP': ((0.0, 0.0, 0.0), ()),
    'command.polar.LINEAR_SPEED': 1.0 / 60.0,
    'command.polar.STILL': (0.0, 0.0, 0.0),
    'navigation.corners.QUARTER': 8,
    'navigation.corners.ROUND': 1.0 / cos(pi / 32),
    'navigation.path_follower.CORNER_REACH': 0.3,
    'navigation.path_follower.CORNER_SLACK': 0.01,
    'navigation.path_follower.PLAN_LIFETIME': 60.0,
    'navigation.path_follower.PLAN_PERIOD': 1.0,
    'navigation.polyline.ROUNDING': 1e-06,
    'navigation.polyline.SAME': 1e-09,
    'navigation.reservations.detour.NEAR': 0.8,
    'navigation.reservations.detour.QUARTER': 3,
    'navigation.reservations.detour.ROUND': 1.0 / cos(pi / 12) + 1e-4,
    'navigation.reservations.doubt.MOST_PLACES': 20,
    'navigation.reservations.needs.ARRIVED': 0.05,
    'navigation.reservations.needs.COURTESY': 4.0,
    'navigation.reservations.peers.LONG_AGO': -1e18,
    'navigation.reservations.peers.MOST_ENDED': 64,
    'navigation.reservations.peers.MOST_RUNS': 16,
    'navigation.reservations.reservation.IDLE': 2**62,
    'navigation.reservations.reservation.LONGEST_NAME': 200,
    'navigation.reservations.reservation.MOST_POINTS': 1000,
    'navigation.reservations.reservation.MOST_RECEIVED': 200,
    'navigation.reservations.reservation.WIDEST': 1000.0,
    'navigation.reservations.right_of_way.MOST_PEERS': 100,
    'navigation.reservations.right_of_way.MOST_PLANNED': 500,
    'navigation.reservations.roster.LARGEST': 1_048_576,
    'navigation.reservations.separation.SAMPLE': 0.05,
    'navigation.reservations.shared_navigator.CHECK_PERIOD': 1.0,
    'navigation.reservations.shared_navigator.LONG_WAY': 60.0,
    'navigation.reservations.shared_navigator.STRETCH': 1.0,
    'navigation.reservations.shared_navigator.STUCK': 5.0,
    'navigation.reservations.sides.SQUARE': 0.5,
    'navigation.reservations.sides.STRIDE': 0.05,
    'navigation.zone.MARGIN': 0.5,
    'navigation.zone_file.DEGREES': 1.0,
    'navigation.zone_text.LONGEST': 200_000,
    'navigation.zone_text.MOST_VALUES': 3000,
}

DEFAULTS = {
    'behavior.agent.Agent._go': {'yields': True},
    'behavior.decision.Decision': {'rules': (True, 1.0)},
    'behavior.goals.strategies.StrategyKind': {'remembers': True},
    'behavior.goals.strategies.GoalParameters': {'seed': 1, 'attempts': 9, 'retry_after': 10.0},
    'behavior.homing.HomeParameters': {
        'speed': 0.5, 'arrival': 0.3, 'spare': 10.0, 'return_speed': 0.25,
    },
    'behavior.memory.MemoryParameters': {'cell': 0.25},
    'behavior.memory.Memory': {'rim': 1.18},
    'behavior.parameters.AgentParameters': {
        'linear_speed': 1.0 / 60.0, 'platform_radius': 1.18,
    },
    'behavior.sap_flow.RestParameters': {'rest_below': 0.15, 'wake_above': 0.2, 'arrival': 1.0},
    'behavior.schedule.ScheduleParameters': {'night_start': 2.0, 'night_end': 7.0},
    'command.floor_rules.FloorRules': {'may_turn': True, 'top_speed': 1.0},
    'command.limits.VRate': {'jerk': inf},
    'command.limits.OmegaRate': {'jerk': inf},
    'command.polar.to_twist': {'linear_speed': 1.0 / 60.0, 'platform_radius': 1.18},
    'command.polar.to_polar': {'linear_speed': 1.0 / 60.0, 'platform_radius': 1.18},
    'command.ramp.Ramp': {'rate': inf, 'jerk': inf},
    'navigation.navigator.StraightNavigator.navigate': {'straight': True},
    'navigation.reservations.needs.Needs.of_all': {'plans': True},
    'navigation.reservations.parameters.TrafficParameters': {
        'body': 1.18, 'margin': 0.2, 'tolerance': 0.3, 'silent_after': 30.0, 'listen': 5.0,
        'patience': 120.0,
    },
    'navigation.reservations.reservation.Reservation': {'journey': 2**62},
    'navigation.reservations.right_of_way.RightOfWay.locate': {'fresh': True},
    'navigation.reservations.shared_navigator.SharedNavigator.rest': {'fresh': True},
    'navigation.reservations.shared_navigator.SharedNavigator._track': {'fresh': True},
    'navigation.zone.Zone': {'margin': 0.5},
    'navigation.zone_file.load_zone': {'rim': 1.18},
}  # fmt: skip


def test_numbers_change_on_purpose_only():
    assert constants('motion') == CONSTANTS


def test_what_nobody_told_is_nothing_or_in_a_table():
    assert defaults('motion') == DEFAULTS
