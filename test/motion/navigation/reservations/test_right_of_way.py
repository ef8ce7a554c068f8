"""The floor is held by one tree at a time, whatever the network does."""

from __future__ import annotations

import random
from itertools import combinations
from math import cos, sin, tau

import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.motion.navigation.polyline import line
from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.motion.navigation.reservations.reservation import Answer
from agv_motion.motion.navigation.reservations.right_of_way import RightOfWay
from agv_motion.motion.navigation.reservations.sides import Sides
from agv_motion.simulation.radio import Radio, RadioParameters

PARAMETERS = TrafficParameters(body=0.7, margin=0.2, tolerance=0.2, listen=0.0, silent_after=30.0)
CLEARANCE = 2.0
"""[m] twice 0.7 + 0.2 + 0.2 / 2"""


def tree(name, x, y=0.0, **changes):
    return RightOfWay(name, (x, y), TrafficParameters(**(PARAMETERS.__dict__ | changes)))


def talk(trees, now, rounds=1):
    """Let every tree hear every other, without loss."""
    for _ in range(rounds):
        for reservation in [one.reservation(now) for one in trees]:
            for other in trees:
                other.receive(reservation, now)


def asks(one, *points):
    one.request((one.held[-1], *points))


def held_gap(a, b):
    return line(a.held).distance(line(b.held))


def test_alone_a_tree_goes_where_it_wants():
    oak = tree('oak', 0.0)
    asks(oak, (5.0, 0.0))
    assert oak.settle(0.0).answer is Answer.GRANTED
    assert oak.held == ((0.0, 0.0), (5.0, 0.0))


def test_it_listens_before_it_asks():
    oak = tree('oak', 0.0, listen=5.0)
    asks(oak, (5.0, 0.0))
    assert oak.settle(10.0).answer is Answer.LISTENING
    assert oak.settle(14.9).answer is Answer.LISTENING
    assert oak.settle(15.0).answer is Answer.GRANTED


def test_it_waits_for_the_trees_it_expects():
    oak, pine = tree('oak', 0.0, expected=('pine',)), tree('pine', 10.0)
    asks(oak, (5.0, 0.0))
    assert str(oak.settle(0.0)).startswith('waits for the answer of pine, which has not spoken')
    talk([oak, pine], 1.0, rounds=2)
    assert oak.settle(1.0).answer is Answer.GRANTED


def test_floor_is_granted_once_the_other_has_answered():
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    talk([oak, pine], 0.0)
    asks(oak, (5.0, 0.0))
    assert str(oak.settle(1.0)) == 'waits for the answer of pine'
    pine.receive(oak.reservation(1.0), 1.0)
    assert oak.settle(1.0).answer is Answer.PENDING
    oak.receive(pine.reservation(2.0), 2.0)
    assert oak.settle(2.0).answer is Answer.GRANTED


def test_nobody_comes_nearer_than_both_radii():
    """Radius 1 m each: from 0, at most 8 m towards a tree at 10."""
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    asks(oak, (8.01, 0.0))
    talk([oak, pine], 0.0, rounds=2)
    assert str(oak.settle(0.0)) == 'waits for pine'
    asks(oak, (8.0, 0.0))
    talk([oak, pine], 1.0, rounds=2)
    assert oak.settle(1.0).answer is Answer.GRANTED


@pytest.mark.parametrize(
    ('oak_set_out', 'pine_set_out', 'first'), [(5, 9, 'oak'), (9, 5, 'pine'), (5, 5, 'oak')]
)
def test_of_two_that_ask_at_once_the_older_journey_goes_first_then_the_name(
    oak_set_out, pine_set_out, first
):
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    oak.set_out(oak_set_out)
    pine.set_out(pine_set_out)
    asks(oak, (5.0, 0.0))
    asks(pine, (5.0, 0.0))
    talk([oak, pine], 0.0, rounds=3)
    granted = [one.name for one in (oak, pine) if one.settle(0.0).answer is Answer.GRANTED]
    assert granted == [first]


def test_a_tree_that_is_too_near_may_go_away_but_not_nearer():
    oak, pine = tree('oak', 0.0), tree('pine', 1.5)
    asks(oak, (0.1, 0.0))
    talk([oak, pine], 0.0, rounds=2)
    assert oak.settle(0.0).answer is Answer.TAKEN
    asks(oak, (-3.0, 0.0))
    talk([oak, pine], 1.0, rounds=2)
    assert oak.settle(1.0).answer is Answer.GRANTED


def test_what_lies_behind_is_let_go():
    oak = tree('oak', 0.0)
    asks(oak, (5.0, 0.0), (5.0, 5.0))
    oak.settle(0.0)
    oak.pass_by(6.0)
    assert oak.held == ((5.0, 1.0), (5.0, 5.0))
    oak.stop()
    assert oak.held == ((5.0, 1.0),)


def test_a_parked_tree_that_knows_this_one_is_an_obstacle_that_need_not_answer():
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    talk([oak, pine], 0.0, rounds=2)
    pine.park()
    oak.receive(pine.reservation(0.0), 0.0)
    asks(oak, (8.0, 0.0))
    assert oak.settle(10_000.0).answer is Answer.GRANTED
    asks(oak, (9.0, 0.0))
    assert oak.settle(10_000.0).answer is Answer.TAKEN


def test_one_that_parked_without_knowing_this_one_is_not_relied_upon():
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    pine.park()
    oak.receive(pine.reservation(0.0), 0.0)
    asks(oak, (1.0, 0.0))
    assert oak.settle(0.0).answer is Answer.PENDING


def test_two_that_each_believe_the_other_parked_do_not_take_the_same_floor():
    """Both parked, then both set out while neither hears the other any more."""
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    talk([oak, pine], 0.0, rounds=2)
    oak.park()
    pine.park()
    talk([oak, pine], 1.0, rounds=2)
    for one in (oak, pine):
        asks(one, (5.0, 0.0))
        one.reservation(2.0)
        assert one.settle(2.0).answer is Answer.PENDING
        one.reservation(100.0)
        assert one.settle(100.0).answer is Answer.TAKEN, 'silent, and nothing is agreed'


def test_two_that_took_each_other_for_parked_and_both_start_again_take_no_floor_unasked():
    """So that one is parked is not kept on disk: each would rely on what it read of the other."""
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    talk([oak, pine], 0.0, rounds=2)
    oak.park()
    pine.park()
    talk([oak, pine], 1.0, rounds=2)
    for name, place, known in (('oak', (0.0, 0.0), 'pine'), ('pine', (10.0, 0.0), 'oak')):
        again = RightOfWay(name, place, PARAMETERS, known=(known,))
        asks(again, (5.0, 0.0))
        again.reservation(0.0)
        assert again.settle(1000.0).answer is Answer.PENDING


def test_a_parked_tree_asks_before_it_moves():
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    talk([oak, pine], 0.0, rounds=2)
    pine.park()
    talk([oak, pine], 1.0)
    asks(pine, (15.0, 0.0))
    assert pine.settle(100.0).answer is Answer.TAKEN, 'oak is silent, and knows nothing of it'
    talk([oak, pine], 101.0, rounds=2)
    assert pine.settle(101.0).answer is Answer.GRANTED


def test_of_a_silent_tree_all_it_asked_for_stays_taken_and_each_keeps_its_side():
    oak, pine = tree('oak', 0.0), tree('pine', 20.0)
    talk([oak, pine], 0.0, rounds=2)
    asks(pine, (15.0, 0.0))
    talk([oak, pine], 1.0)
    asks(oak, (6.0, 0.0))
    assert oak.settle(100.0).answer is Answer.GRANTED  # 6 + 2 <= 9
    asks(oak, (6.6, 0.0))
    assert str(oak.settle(101.0)) == 'waits for pine, which is silent'  # 6.6 + 2 > 8.4
    talk([oak, pine], 102.0, rounds=2)
    assert oak.settle(102.0).answer is Answer.GRANTED


def test_a_silent_tree_that_knew_nothing_of_this_one_is_not_relied_upon():
    oak, pine = tree('oak', 0.0), tree('pine', 20.0)
    oak.receive(pine.reservation(0.0), 0.0)
    asks(oak, (1.0, 0.0))
    assert oak.settle(100.0).answer is Answer.TAKEN


def test_a_message_overtaken_by_a_later_one_is_dropped():
    oak, pine = tree('oak', 0.0), tree('pine', 20.0)
    early = pine.reservation(0.0)
    pine.locate((8.0, 0.0), 0.5)
    oak.receive(pine.reservation(1.0), 1.0)
    oak.receive(early, 2.0)
    asks(oak, (7.0, 0.0))
    assert oak.settle(2.0).answer is Answer.TAKEN


def test_two_trees_of_one_name_are_told_and_neither_moves_while_the_other_speaks():
    oak, other = tree('oak', 0.0), tree('oak', 10.0)
    asks(oak, (3.0, 0.0))
    oak.reservation(0.0)
    with pytest.raises(SignalError, match="calls itself 'oak'"):
        oak.receive(other.reservation(1.0), 1.0)
    assert "calls itself 'oak'" in oak.obstacle(31.0)
    assert oak.settle(31.0).answer is Answer.ALARM
    assert oak.settle(31.1).answer is Answer.GRANTED


def test_the_floor_of_a_twin_that_heard_this_tree_stays_taken():
    oak, twin = tree('oak', 0.0), tree('oak', 4.0)
    for hearer, speaker in ((twin, oak), (oak, twin)):
        with pytest.raises(SignalError, match='give each its own name'):
            hearer.receive(speaker.reservation(0.0), 0.0)
    asks(oak, (2.5, 0.0))
    oak.reservation(100.0)
    assert oak.settle(100.0).answer is Answer.TAKEN


def test_a_third_tree_tells_two_of_one_name_apart_and_stands():
    """Both answer it in turn: neither can have ended before the other began."""
    oak, one, other = tree('oak', 0.0), tree('pine', 10.0), tree('pine', 20.0)
    for _ in range(4):
        for twin in (one, other):
            twin.receive(oak.reservation(0.0), 0.0)
            oak.receive(twin.reservation(0.0), 0.0)
    assert "call themselves 'pine'" in oak.obstacle(30.0)
    asks(oak, (1.0, 0.0))
    oak.reservation(30.0)
    assert oak.settle(30.0).answer is Answer.ALARM


def test_after_a_reservation_that_was_refused_nobody_moves_for_a_while():
    oak = tree('oak', 0.0)
    asks(oak, (3.0, 0.0))
    oak.alarm('a reservation was refused', 5.0)
    assert str(oak.settle(35.0)) == 'stands: a reservation was refused'
    assert oak.settle(35.1).answer is Answer.GRANTED


def test_more_trees_than_a_zone_holds_are_told_and_nobody_moves():
    oak = tree('oak', 0.0)
    for i in range(100):
        oak.receive(tree(f'tree_{i}', 50.0).reservation(0.0), 0.0)
    with pytest.raises(SignalError, match="'pine' is one tree more than 100"):
        oak.receive(tree('pine', 50.0).reservation(0.0), 0.0)
    assert len(oak.peers) == 100
    assert 'one tree more' in oak.obstacle(1.0)
    assert len(oak.reservation(1.0).received) == 100


# Runs: a tree that starts again knows nothing


def test_an_answer_to_an_earlier_run_is_none_for_this_one():
    """The clock fell back over the restart; what counts is the run."""
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    for _ in range(5):
        talk([oak, pine], 1000.0)
    late = pine.reservation(1000.0)
    oak = tree('oak', 0.0)
    asks(oak, (5.0, 0.0))
    oak.reservation(0.0)
    oak.receive(late, 0.0)
    assert oak.settle(0.0).answer is Answer.PENDING


def test_of_a_peer_that_starts_again_old_and_new_floor_stay_taken_until_it_answers():
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    talk([oak, pine], 1000.0, rounds=2)
    again = tree('pine', 20.0)
    oak.receive(again.reservation(0.0), 1001.0)
    for target, answer in (((8.5, 0.0), Answer.TAKEN), ((2.0, 0.0), Answer.PENDING)):
        asks(oak, target)
        oak.reservation(1002.0)
        assert oak.settle(1002.0).answer is answer
    talk([oak, again], 1003.0, rounds=2)
    asks(oak, (8.5, 0.0))
    talk([oak, again], 1004.0, rounds=2)
    assert oak.settle(1004.0).answer is Answer.GRANTED


def test_a_late_word_of_an_ended_run_changes_nothing():
    oak, pine = tree('oak', 0.0), tree('pine', 20.0)
    talk([oak, pine], 0.0, rounds=2)
    late, again = pine.reservation(1.0), tree('pine', 8.0)
    talk([oak, again], 2.0, rounds=3)
    oak.receive(late, 3.0)
    assert oak.obstacle(3.0) == ''
    asks(oak, (7.0, 0.0))
    oak.reservation(3.0)
    assert oak.settle(3.0).answer is Answer.TAKEN, 'the present run stands at 8'


def test_a_late_word_of_a_run_never_heard_before_is_not_taken_for_the_present_one():
    """The first run's words come after the second's: until an answer tells, both are taken."""
    oak, first = tree('oak', 0.0), tree('pine', 20.0)
    first.receive(oak.reservation(0.0), 0.0)
    late, again = first.reservation(0.0), tree('pine', 8.0)
    oak.receive(again.reservation(1.0), 1.0)
    oak.receive(late, 2.0)
    asks(oak, (7.0, 0.0))
    assert oak.settle(2.0).answer is Answer.TAKEN
    talk([oak, again], 3.0, rounds=2)
    assert [len(peer.floors()) for peer in oak.peers] == [1]


def test_the_answer_of_a_run_that_may_have_ended_is_not_relied_upon():
    """The first run had heard the request; it came late, after a word of the second."""
    oak, first = tree('oak', 0.0), tree('pine', 20.0)
    asks(oak, (5.0, 0.0))
    first.receive(oak.reservation(0.0), 0.0)
    late, again = first.reservation(0.0), tree('pine', 20.0)
    oak.receive(again.reservation(1.0), 1.0)
    oak.receive(late, 2.0)
    assert oak.settle(2.0).answer is Answer.PENDING
    talk([oak, again], 3.0, rounds=2)
    assert oak.settle(3.0).answer is Answer.GRANTED


def test_it_waits_for_all_that_an_earlier_run_knew():
    oak = RightOfWay('oak', (0.0, 0.0), PARAMETERS, known=('pine',))
    asks(oak, (5.0, 0.0))
    oak.reservation(0.0)
    assert 'waits for the answer of pine' in str(oak.settle(1000.0))
    assert 'take it out of traffic.expected and peers_file' in str(oak.settle(1000.0))


def test_a_request_of_a_silent_tree_counts_as_granted_however_near_it_is():
    """It asked for floor 1.5 m from here; had it been answered, it may be there by now."""
    oak, pine = tree('oak', 0.5), tree('pine', 4.0)
    talk([oak, pine], 0.0, rounds=2)
    asks(pine, (2.0, 0.0))
    talk([oak, pine], 1.0)
    asks(oak, (0.6, 0.0))
    oak.reservation(100.0)
    assert oak.settle(100.0).answer is Answer.TAKEN
    assert [peer.floors()[0].line.bounds[0] for peer in oak.peers] == [2.0]


def test_who_stands_on_the_floor_of_another_may_leave_it_but_not_along_it_towards_the_other():
    """Carried there: pine holds all from 0 to 6 m and stands at 0, 1.5 m away."""
    oak, pine = tree('oak', 1.5), tree('pine', 0.0)
    asks(pine, (6.0, 0.0))
    assert pine.settle(0.0).answer is Answer.GRANTED
    talk([oak, pine], 0.0, rounds=2)
    for target, answer in (((1.4, 0.0), Answer.TAKEN), ((1.5, -1.0), Answer.GRANTED)):
        asks(oak, target)
        talk([oak, pine], 0.0, rounds=2)
        assert oak.settle(0.0).answer is answer


# Places: a tree whose pose jumps does not know where it is


def test_a_tree_whose_pose_jumps_holds_the_old_and_the_new_place_until_it_is_sure():
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    talk([oak, pine], 0.0, rounds=2)
    assert oak.locate((0.0, 0.1), 1.0)
    assert not oak.locate((5.0, 5.0), 2.0)
    assert oak.held == ((5.0, 5.0), (0.0, 0.0))
    asks(oak, (-1.0, 0.0))
    talk([oak, pine], 3.0, rounds=2)
    assert 'off its way' in str(oak.settle(3.0))
    oak.stop()
    oak.pass_by(1.0)
    assert oak.held == ((5.0, 5.0), (0.0, 0.0)), 'nothing is let go'
    for target in ((1.9, 0.0), (5.0, 3.1)):
        pine.withdraw()
        asks(pine, target)
        talk([oak, pine], 3.0, rounds=2)
        assert pine.settle(3.0).answer is Answer.TAKEN
    assert not oak.locate((5.1, 5.0), 32.0)
    assert oak.locate((5.1, 5.0), 32.1)
    assert oak.held == ((5.0, 5.0),)
    assert oak.obstacle(32.1) == ''


def test_a_wrong_fix_that_comes_and_goes_frees_no_floor_on_which_the_tree_stands():
    oak = tree('oak', 0.0)
    for now in range(300):
        assert not oak.locate((5.0, 5.0) if now % 40 < 29 else (0.0, 0.0), float(now))
        assert line(oak.held).distance(shapely.Point(0.0, 0.0)) == 0.0


def test_a_pose_that_is_only_remembered_makes_nothing_surer():
    oak = tree('oak', 0.0)
    oak.locate((5.0, 5.0), 0.0)
    assert not oak.locate((5.0, 5.0), 500.0, fresh=False)
    assert not oak.locate((5.0, 5.0), 530.0)
    assert oak.locate((5.0, 5.0), 530.1)


def test_one_that_parks_in_doubt_holds_all_places_where_it_may_be():
    oak = tree('oak', 0.0)
    oak.locate((5.0, 5.0), 0.0)
    oak.park()
    assert oak.reservation(1.0).held == ((5.0, 5.0), (0.0, 0.0))


def test_a_tree_that_was_carried_has_no_side_by_what_a_silent_one_heard_before():
    """Oak was at 0 when pine heard it last, so pine may come to 9; from 10 oak must not go on."""
    for hears_of_it, answer in ((False, Answer.TAKEN), (True, Answer.GRANTED)):
        oak, pine = tree('oak', 0.0), tree('pine', 20.0)
        talk([oak, pine], 0.0, rounds=2)
        oak.locate((10.0, 0.0), 1.0)
        if hears_of_it:
            talk([oak, pine], 1.0, rounds=2)
        oak.locate((10.0, 0.0), 31.5)
        asks(oak, (10.5, 0.0))
        oak.reservation(100.0)
        assert oak.settle(100.0).answer is answer


def test_who_is_taken_to_be_here_too_may_not_be_walked_at_where_it_may_be_as_well():
    """Pine stands at 2 and believes to be at 0, on oak: away from there is not away from pine."""
    oak, pine = tree('oak', 0.0), tree('pine', 2.0)
    talk([oak, pine], 0.0, rounds=2)
    pine.locate((0.0, 0.0), 1.0)
    for target, answer in (((1.0, 0.0), Answer.TAKEN), ((-1.0, 0.0), Answer.GRANTED)):
        oak.withdraw()
        asks(oak, target)
        talk([oak, pine], 1.0, rounds=2)
        assert oak.settle(1.0).answer is answer


def test_on_the_floor_of_a_silent_tree_nobody_walks_towards_where_it_may_have_got_to():
    oak, pine = tree('oak', 3.0), tree('pine', 0.0)
    asks(pine, (6.0, 0.0))
    pine.settle(0.0)
    talk([oak, pine], 0.0, rounds=2)
    for target, answer in (((5.0, 0.0), Answer.TAKEN), ((3.0, 1.0), Answer.GRANTED)):
        oak.withdraw()
        asks(oak, target)
        talk([oak, pine], 0.0, rounds=2)
        assert oak.settle(0.0).answer is answer


# Who lies, is doubled, or comes back from the past


def test_of_a_peer_that_starts_again_smaller_the_larger_radius_counts_until_it_answers():
    """It was 1.0 m wide and is 0.5 m now: what its last run holds is as wide as that run was."""
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    talk([oak, pine], 0.0, rounds=2)
    again = tree('pine', 10.0, body=0.3)
    oak.receive(again.reservation(1.0), 1.0)
    asks(oak, (8.01, 0.0))
    oak.reservation(1.0)
    assert oak.settle(1.0).answer is Answer.TAKEN
    talk([oak, again], 2.0, rounds=2)
    assert oak.settle(2.0).answer is Answer.GRANTED


def test_words_of_the_past_that_are_played_back_grant_nothing():
    """A recording of /paths on the live network, after oak has started again and pine has gone."""
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    recorded = []
    for now in range(5):
        asks(pine, (9.0, 0.0))
        recorded += [oak.reservation(float(now)), pine.reservation(float(now))]
        talk([oak, pine], float(now))
    again = RightOfWay('oak', (0.0, 0.0), PARAMETERS, known=('pine',))
    asks(again, (5.0, 0.0))
    for now in range(100):
        again.reservation(float(now))
        for reservation in recorded:
            if reservation.name == 'oak':
                with pytest.raises(SignalError, match="calls itself 'oak'"):
                    again.receive(reservation, float(now))
            else:
                again.receive(reservation, float(now))
        assert again.settle(float(now)).answer is not Answer.GRANTED
    again.reservation(1000.0)
    assert again.settle(1000.0).answer is not Answer.GRANTED


def test_words_of_the_present_run_that_are_played_back_change_nothing():
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    recorded = []
    for now in range(5):
        recorded.append(pine.reservation(float(now)))
        talk([oak, pine], float(now))
    pine.locate((3.5, 0.0), 5.0)
    talk([oak, pine], 5.0, rounds=2)
    for reservation in recorded:
        oak.receive(reservation, 6.0)
    asks(oak, (2.0, 0.0))
    oak.reservation(6.0)
    assert oak.settle(6.0).answer is Answer.TAKEN
    assert oak.obstacle(6.0) == ''


def test_a_run_that_has_ended_and_is_played_back_to_one_that_never_heard_it_grants_nothing():
    """Also while the present run answers: it has to answer a word sent after each of them came."""
    ash, pine, oak = tree('ash', 0.0, 5.0), tree('pine', 8.0), tree('oak', 0.0)
    talk([ash, pine], 0.0, rounds=2)
    recorded, again = pine.reservation(0.0), tree('pine', 20.0)
    asks(oak, (7.0, 0.0))
    talk([oak, again], 1.0, rounds=2)
    oak.receive(recorded, 2.0)
    assert oak.settle(2.0).answer is Answer.TAKEN
    talk([oak, again], 3.0, rounds=2)
    assert oak.settle(3.0).answer is Answer.GRANTED


def test_a_restart_while_its_request_is_pending_takes_nothing_by_the_answer_to_it():
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    talk([oak, pine], 0.0, rounds=2)
    asks(oak, (5.0, 0.0))
    pine.receive(oak.reservation(1.0), 1.0)
    answer, again = (
        pine.reservation(1.0),
        RightOfWay('oak', (0.0, 0.0), PARAMETERS, known=('pine',)),
    )
    again.receive(answer, 2.0)
    asks(again, (5.0, 0.0))
    again.reservation(2.0)
    again.receive(answer, 2.0)
    assert again.settle(2.0).answer is Answer.PENDING


def test_two_of_one_name_on_both_sides_of_a_split_network_stop_all_once_it_is_whole():
    oak, one, other = tree('oak', 0.0), tree('pine', 10.0), tree('pine', 0.0, 10.0)
    talk([oak, one], 0.0, rounds=3)
    told = 0
    for now in range(1, 5):
        for twin in (one, other):
            twin.receive(oak.reservation(now), now)
        messages = [one.reservation(now), other.reservation(now)]
        for message_id in messages:
            oak.receive(message_id, now)
        for twin, message_id in ((one, messages[1]), (other, messages[0])):
            with pytest.raises(SignalError, match="calls itself 'pine'"):
                twin.receive(message_id, now)
            told += 1
    assert told == 8
    for each in (oak, one, other):
        asks(each, (each.held[0][0] + 0.1, each.held[0][1]))
        each.reservation(5.0)
        assert each.settle(5.0).answer is Answer.ALARM


def test_a_map_in_national_metres_is_one():
    oak = tree('oak', 6.8e6, 6.8e6)
    asks(oak, (6.8e6 + 1.0, 6.8e6))
    assert oak.reservation(0.0).requested[-1] == (6.8e6 + 1.0, 6.8e6)


def test_radius_and_margin_may_differ_and_the_larger_margin_holds():
    """0.9 + 0.6 of radius and 0.5 of margin: 2.0 m."""
    oak = tree('oak', 0.0)
    pine = tree('pine', 10.0, body=0.3, tolerance=0.3, margin=0.5)
    asks(oak, (8.01, 0.0))
    talk([oak, pine], 0.0, rounds=2)
    assert oak.settle(0.0).answer is Answer.TAKEN
    oak.withdraw()
    asks(pine, (2.0, 0.0))
    talk([oak, pine], 0.0, rounds=2)
    assert pine.settle(0.0).answer is Answer.GRANTED


def test_journeys_are_ordered_by_who_had_heard_of_whom_not_by_clocks():
    oak, pine = tree('oak', 0.0), tree('pine', 10.0)
    oak.set_out()
    pine.receive(oak.reservation(5000.0), -5000.0)
    pine.set_out()
    assert oak.precedence < pine.precedence
    oak.receive(pine.reservation(-5000.0), 5000.0)
    oak.set_out()
    assert pine.precedence < oak.precedence


def test_its_own_message_coming_back_says_nothing():
    oak = tree('oak', 0.0)
    oak.receive(oak.reservation(0.0), 0.0)
    assert len(oak.peers) == 0


def test_every_message_of_a_run_has_a_number_of_its_own_whatever_the_clock_says():
    oak = tree('oak', 0.0)
    assert [oak.reservation(now).message_id.number for now in (100.0, 50.0, 50.0)] == [0, 1, 2]
    assert oak.reservation(0.0).message_id.run != tree('oak', 0.0).reservation(0.0).message_id.run


POINTS = st.tuples(st.floats(-8.0, 8.0), st.floats(-8.0, 8.0))
WAYS = st.lists(POINTS, min_size=1, max_size=3, unique=True).map(tuple)


@given(a=WAYS, b=WAYS, p=WAYS, q=WAYS)
def test_two_that_keep_to_their_sides_never_meet(a, b, p, q):
    """Whatever A and B hold, and even where each thinks the other holds more than it does."""
    mine, theirs = Sides(line(a), line((*b, *q[:1]))), Sides(line(b), line((*a, *p[:1])))
    if mine.allow(p, CLEARANCE) and theirs.allow(q, CLEARANCE):
        assert line(p).distance(line(q)) >= CLEARANCE - 1e-9


def test_the_floor_left_to_the_other_side_is_told_in_squares():
    closed = Sides(shapely.Point(0, 0), shapely.Point(10, 0)).closed((-5.0, -5.0, 15.0, 5.0), 2.0)
    assert shapely.intersects_xy(closed, 9.0, 0.0)
    assert shapely.intersects_xy(closed, 5.0, 0.0)
    assert not shapely.intersects_xy(closed, 0.0, 0.0)
    assert not shapely.intersects_xy(closed, -4.0, 3.0)


class Chaos:
    """Trees that ask at random over a network that loses, delays, reorders and falls silent."""

    def __init__(self, seed, count):
        self.chance = random.Random(seed)  # noqa: S311 - a trial, no secret
        self.now = 0.0
        places = [(3.0 * k + self.chance.uniform(0.0, 0.5), 0.0) for k in range(count)]
        self.trees = [tree(f'tree_{k}', *place) for k, place in enumerate(places)]
        self.skew = {one.name: self.chance.uniform(-5.0, 5.0) for one in self.trees}
        self.radio = Radio(list(self.skew), RadioParameters(loss=0.2, delay=5.0), seed)
        self.granted = 0
        talk(self.trees, 0.0, rounds=2)

    def step(self):
        """Hear, ask, settle, walk, tell: each at random."""
        self.now += self.chance.uniform(0.1, 2.0)
        by_name = {one.name: one for one in self.trees}
        for name, reservation in self.radio.receive(self.now):
            by_name[name].receive(reservation, self.now + self.skew[name])
        if self.chance.random() < 0.01:
            pairs = [(a, b) for a in by_name for b in by_name if a != b]
            self.radio.deaf = {pair for pair in pairs if self.chance.random() < 0.4}
        if self.chance.random() < 0.03:
            self.radio.deaf = set()
        for one in self.trees:
            self.act(one)
            if self.chance.random() < 0.8:
                self.radio.send(one.reservation(self.now + self.skew[one.name]), self.now)

    def act(self, one):
        chance = self.chance
        if one.requested:
            answer = one.settle(self.now + self.skew[one.name]).answer
            self.granted += answer is Answer.GRANTED
            if answer is Answer.TAKEN:
                one.withdraw()
        elif chance.random() < 0.5:
            x, y = one.held[-1]
            angle, far = chance.uniform(0.0, tau), chance.uniform(0.1, 3.0)
            target = (x + far * cos(angle), y + far * sin(angle))
            one.request(((x, y), (0.9 * target[0], 0.9 * target[1])))
        dice = chance.random()
        if dice < 0.3:
            one.pass_by(chance.uniform(0.0, one.ahead))
        elif dice < 0.32:
            one.stop()
        elif dice < 0.34:
            one.withdraw()
        elif dice < 0.36:
            one.set_out()
        elif dice < 0.37:
            one.park()


@pytest.mark.parametrize('seed', range(8))
def test_no_two_ways_held_ever_overlap(seed):
    """The invariant: by simulation of what no proof should be trusted with alone."""
    chaos = Chaos(seed, count=2 + seed % 4)
    for _ in range(700):
        chaos.step()
        for a, b in combinations(chaos.trees, 2):
            assert held_gap(a, b) >= CLEARANCE - 1e-5
    assert chaos.granted > 100
