"""What a tree drank today, as the page is told it: litres while they are news, else hours."""

from __future__ import annotations

import json
from math import nan

import pytest

from agv_motion.dashboard.core.board import Board
from agv_motion.dashboard.core.drank import TODAY
from agv_motion.probe.water import LONGEST_GAP

NOON = 12 * 3600.0


def drank(board, now):
    """Return what the page is told at a time; None where it is told nothing."""
    board.refresh(now)
    cell = board.cells.get(('oak', 'drank'))
    return None if cell is None else json.loads(cell.update)['value']


def test_litres_come_with_their_interval_before_any_sap_flow_is_known(messages):
    board = Board()
    board.receive('oak', TODAY, NOON, messages.sap_flow(12.3456, 10.1, 15.0, NOON))
    litres = {'value': 12.346, 'low': 10.1, 'high': 15.0}
    assert drank(board, NOON + 5.0) == {'hours': None, 'litres': litres}


def test_without_an_area_of_sapwood_there_are_hours_at_full_flow_alone(messages):
    board = Board()
    assert drank(board, NOON) is None
    for seconds in (2.0, 362.0):
        now = NOON + seconds
        board.receive('oak', 'granier/sap_flow', now, messages.sap_flow(1.0, 0.5, 0.0, now))
        board.look(now)
    assert drank(board, NOON + 364.0) == {'hours': 0.05, 'litres': None}


def test_litres_of_a_probe_that_fell_silent_are_of_today_no_more(messages):
    board = Board()
    board.receive('oak', TODAY, NOON, messages.sap_flow(3.0, 1.0, 9.0, NOON))
    assert drank(board, NOON + LONGEST_GAP - 1.0)['litres']['value'] == 3.0
    assert drank(board, NOON + LONGEST_GAP + 1.0) == {'hours': None, 'litres': None}


@pytest.mark.parametrize('wrong', [nan, float('inf')])
def test_what_is_no_number_is_not_told(messages, wrong):
    board = Board()
    board.receive('oak', TODAY, NOON, messages.sap_flow(3.0, 1.0, wrong, NOON))
    assert drank(board, NOON)['litres'] is None
