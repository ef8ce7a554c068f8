"""A reservation that would void the promises is refused; who goes first is never in doubt."""

from __future__ import annotations

from math import nan

import pytest

from agv_motion.errors import SignalError
from agv_motion.motion.navigation.reservations.reservation import (
    GRANTED,
    IDLE,
    Answer,
    MessageId,
    Reservation,
    Ruling,
)


def reservation(name='oak', **given):
    return Reservation(name, MessageId(1, 1), 1.0, ((0.0, 0.0), (1.0, 0.0)), **given)


@pytest.mark.parametrize(
    ('changes', 'complaint'),
    [
        ({'name': ''}, 'needs name, place'),
        ({'held': ()}, 'needs name, place'),
        ({'radius': nan}, 'radius nan'),
        ({'radius': 0.0}, 'must be positive'),
        ({'requested': ((0.0, 0.0), (nan, 1.0))}, 'must be finite'),
        ({'planned': ((0.0, 1e9),)}, 'must be finite and within'),
        ({'planned': ((0.0, 1.0),) * 1001}, 'at most 1000'),
        ({'radius': 1e9}, 'must be positive, <= 1000'),
        ({'margin': nan}, 'margin nan'),
        ({'name': 'x' * 201}, 'at most 200'),
        ({'journey': -1}, 'must lie in'),
        ({'message_id': MessageId(1, -1)}, 'must lie in'),
        ({'received': {'pine': MessageId(2**64, 0)}}, 'must lie in'),
    ],
)
def test_a_reservation_that_says_nothing_sound_is_refused(changes, complaint):
    sound = {'name': 'oak', 'message_id': MessageId(1, 1), 'radius': 1.0, 'held': ((0.0, 0.0),)}
    with pytest.raises(SignalError, match=complaint):
        Reservation(**(sound | changes))


def test_the_older_journey_goes_first_then_the_name_and_who_stands_goes_last():
    ash, oak, elm = reservation('ash', journey=2), reservation(journey=1), reservation('elm')
    assert sorted([elm, ash, oak], key=lambda one: one.precedence) == [oak, ash, elm]
    assert elm.journey == IDLE
    assert reservation('ash', journey=1).precedence < oak.precedence


def test_what_it_may_hold_by_now_is_what_it_holds_and_requests():
    both = reservation(requested=((1.0, 0.0), (1.0, 2.0)))
    assert both.requested_line.length == 2.0
    assert both.both.length == both.most_floor.line.length == 3.0
    assert both.floor.line.length == 1.0


def test_a_ruling_in_words():
    assert str(GRANTED) == 'granted'
    assert str(Ruling(Answer.TAKEN, 'ash')) == 'waits for ash'
    assert str(Ruling(Answer.LISTENING)) == 'listens who else is there'
