"""Every order of events between two and three trees, as far as a test may look; and does it see?

The long form is launch_scripts/trials/search_traffic.py.
"""

from __future__ import annotations

import pytest

from agv_motion.motion.navigation.reservations.doubt import Doubt
from agv_motion.motion.navigation.reservations.peers import Peer, Peers
from agv_motion.motion.navigation.reservations.right_of_way import RightOfWay
from agv_motion.simulation.trials.traffic_search import EVENTS, Search, SearchParameters

RESTARTED = {'restarted': True, 'rounds': 3, 'messages': 4, 'events': ()}
MUTUAL = {'rounds': 2, 'events': ()}
THREE = {
    'cells': (0, 2, 4), 'rounds': 2, 'requested': True, 'late': 1, 'messages': 4, 'events': (),
}  # fmt: skip
PARKED = {'parked': True, 'events': ()}
THREE_PARKED = THREE | {'parked': True}
WRONG = {'cells': (1, 2), 'rounds': 2, 'events': ('wrong fix', 'withdraw')}


@pytest.mark.parametrize(
    'given',
    [
        {'cells': (0, 3), 'events': EVENTS},
        {'cells': (0, 3), 'rounds': 2, 'events': ('silence',)},
        {'cells': (0, 2), 'rounds': 2, 'events': ('restart', 'park')},
        {'cells': (0, 2), **PARKED},
        {'cells': (0, 2), **RESTARTED},
        WRONG,
        {'cells': (0, 2), 'rounds': 2, 'events': ('wrong fix', 'restart', 'silence')},
    ],
)
def test_no_order_of_events_lets_two_hold_the_same_floor(given):
    found = Search(SearchParameters(states=1500, **given)).run()
    assert found.breach == ()
    assert found.complete or found.states == 1500


@pytest.mark.parametrize('what', ['parked', 'restarted', 'requested', ''])
def test_a_search_begins_as_asked_and_not_otherwise(what):
    given = SearchParameters(cells=(0, 2), **({what: True} if what else {}))
    trees = Search(given)._start.trees  # noqa: SLF001
    assert {tree.parked for tree in trees} == {what == 'parked'}
    assert [tree.run for tree in trees] == [2 if what == 'restarted' else 1, 1]
    towards = [((0.0, 0.0), (1.0, 0.0)), ((2.0, 0.0), (1.0, 0.0))]
    assert [tree.requested for tree in trees] == (towards if what == 'requested' else [(), ()])


@pytest.mark.parametrize(
    ('given', 'states'),
    [({'cells': (0, 2), **MUTUAL}, 1000), (THREE, 1800), (THREE_PARKED, 1800)],
)
def test_nor_where_floor_is_taken_in_what_was_searched(given, states):
    """A search in which nobody may move proves nothing."""
    found = Search(SearchParameters(states=states, **given)).run()
    assert found.granted > 10
    assert found.breach == ()
    assert found.complete or found.states == states


def answers_to_any_run(peers, reservation):
    message_id = reservation.received.get(peers._name)  # noqa: SLF001
    return message_id.number if message_id is not None else -1


@pytest.mark.parametrize(
    ('thing', 'name', 'broken', 'given'),
    [
        (Peer, 'stays', property(lambda peer: peer.reservation.parked), PARKED),
        (Peers, 'forget_agreements', lambda *_: None, PARKED),
        (Peers, 'echo', answers_to_any_run, RESTARTED),
        (RightOfWay, 'precedence', property(lambda _: (0, '')), MUTUAL),
        (Peer, 'answered', lambda *_: True, MUTUAL),
        (Peers, 'forget_agreements', lambda *_: None, THREE_PARKED),
        (Doubt, 'floor', property(lambda doubt: doubt.places), WRONG),
    ],
    ids=['parked', 'unparked', 'runs', 'precedence', 'answers', 'three unparked', 'wrong fix'],
)
def test_a_rule_that_is_broken_is_seen(monkeypatch, thing, name, broken, given):
    monkeypatch.setattr(thing, name, broken)
    found = Search(SearchParameters(**({'states': 15_000, 'cells': (0, 2)} | given))).run()
    assert found.breach
