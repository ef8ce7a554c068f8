"""Numbers of this room: what nobody told is nothing, a number changes on purpose only."""

from __future__ import annotations

from room_numbers import constants, defaults

CONSTANTS = {
    'action_run.EASE': 0.5,
    'actions.ANYWHERE': (-100000.0, 100_000.0),
    'sequence_file.LONGEST': 1_000_000.0,
}

DEFAULTS = {
    'actions.DriveArc': {'speed': 0.4, 'acceleration': 0.3},
    'actions.GoTo': {'curve': 0.4, 'speed': 0.4, 'acceleration': 0.3},
    'actions.Rotate': {'speed': 45.0, 'acceleration': 60.0},
    'prediction.predict': {'dt': 0.05},
}  # fmt: skip


def test_numbers_change_on_purpose_only():
    assert constants('sequence') == CONSTANTS


def test_what_nobody_told_is_nothing_or_in_a_table():
    assert defaults('sequence') == DEFAULTS
