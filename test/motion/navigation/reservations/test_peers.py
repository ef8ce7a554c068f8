"""What one tree knows of the others: last words, runs, answers, silence, and objections."""

from __future__ import annotations

import shapely

from agv_motion.motion.navigation.reservations.peers import Peers
from agv_motion.motion.navigation.reservations.reservation import (
    GRANTED,
    IDLE,
    Answer,
    MessageId,
    Reservation,
)

RUN, SILENT_AFTER = 7, 30.0
HERE = shapely.Point(0.0, 0.0)
AHEAD = ((0.0, 0.0), (1.0, 0.0))


def ash(number, *, run=1, knows=-1, x=10.0, **given):
    received = {'oak': MessageId(RUN, knows)} if knows >= 0 else {}
    return Reservation('ash', MessageId(run, number), 0.5, ((x, 0.0),), received=received, **given)


def heard(*messages, now=0.0, next_number=5):
    """Return the peers of oak after some messages of ash, and ash as oak knows it."""
    peers = Peers('oak', RUN, SILENT_AFTER)
    for message in messages:
        peers.receive(message, now, next_number)
    (peer,) = peers
    return peers, peer


def test_a_message_overtaken_by_a_later_one_of_its_run_is_dropped():
    _, peer = heard(ash(3, x=10.0), ash(2, x=20.0))
    assert peer.reservation.message_id.number == 3


def test_both_runs_stay_taken_until_the_new_one_has_answered():
    _, peer = heard(ash(3, x=10.0), ash(0, run=2, x=20.0))
    assert len(peer.floors()) == 2
    assert not peer.answered(0)
    _, peer = heard(ash(3, x=10.0), ash(0, run=2, x=20.0), ash(1, run=2, x=20.0, knows=5))
    assert len(peer.floors()) == 1
    assert peer.answered(5)


def test_a_run_that_has_ended_and_answers_again_is_a_second_tree_of_that_name():
    peers, _ = heard(ash(3), ash(0, run=2, knows=5), ash(4, knows=5))
    assert peers.doubled(0.0) == ['ash']
    assert peers.doubled(SILENT_AFTER + 1.0) == []


def test_a_peer_not_heard_for_long_is_silent_and_sides_are_agreed_if_it_knew_of_this_tree():
    for knows, agreed in ((5, True), (-1, False)):
        peers, peer = heard(ash(1, knows=knows))
        peers.judge(SILENT_AFTER, HERE, 0)
        assert not peer.silent
        peers.judge(SILENT_AFTER + 0.1, HERE, 0)
        assert (peer.silent, peer.sides is not None) == (True, agreed)
        assert peers.received() == {}


def test_an_objection_is_that_floor_is_taken_or_that_no_answer_has_come():
    mine = (1, 'oak')

    def ruling(message, asked_in=5, precedence=mine):
        return heard(message)[1].objection(AHEAD, asked_in, 1.2, precedence)

    assert ruling(ash(1, knows=5)) == GRANTED
    assert ruling(ash(1, knows=4)).answer is Answer.PENDING
    assert ruling(ash(1, knows=5), asked_in=None).answer is Answer.PENDING
    assert ruling(ash(1, knows=5, x=2.0)).answer is Answer.TAKEN
    crossing = {'requested': ((10.0, 0.0), (1.0, 0.0)), 'knows': 5}
    assert ruling(ash(1, journey=2, **crossing)) == GRANTED
    assert ruling(ash(1, journey=1, **crossing)).answer is Answer.TAKEN


def test_who_is_parked_and_knows_of_this_tree_needs_no_answer():
    assert heard(ash(1, knows=5, parked=True))[1].objection(AHEAD, None, 1.2, (1, 'oak')) == GRANTED
    pending = heard(ash(1, parked=True))[1].objection(AHEAD, None, 1.2, (1, 'oak'))
    assert pending.answer is Answer.PENDING


def test_the_latest_journey_is_that_of_one_that_has_set_out():
    peers, _ = heard(ash(1, journey=4))
    assert peers.latest_journey() == 4
    peers, _ = heard(ash(1, journey=IDLE))
    assert peers.latest_journey() == 0
