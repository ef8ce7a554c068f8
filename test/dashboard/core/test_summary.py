"""One colour, one word, one sentence: what a person sees from three metres."""

from __future__ import annotations

import pytest

from agv_motion.dashboard.core.board import Board
from agv_motion.dashboard.core.summary import summary


@pytest.fixture
def oak(messages):
    """Return a board with a tree that stands, and says so now."""
    board = Board()
    board.receive('oak', 'turrets/state', 100.0, messages.turrets(rates=(0.0, 0.0, 0.0)))
    board.receive('oak', 'pose', 100.0, messages.pose())
    return board


def told(board, now=100.5):
    board.look(now)
    return summary(board.robots['oak'], now)


def node(board, messages, level=0, message='', at=100.0, **values):
    status = messages.status('/oak/motion_generator', level, message, **values)
    board.receive('', 'diagnostics', at, messages.diagnostics(status))


@pytest.mark.parametrize(
    ('activity', 'colour'),
    [('walking', 'green'), ('resting', 'green'), ('closed', 'green'), ('waiting', 'yellow'),
     ('paused', 'yellow'), ('blocked', 'red'), ('stopped', 'red'), ('something new', 'yellow')],
)  # fmt: skip
def test_the_word_is_the_activity_of_the_robot(oak, messages, activity, colour):
    node(oak, messages, activity=activity)
    found = told(oak)
    assert (found['word'], found['colour']) == (activity, colour)


@pytest.mark.parametrize(('hours', 'asked'), [('asked', True), ('closed', False), ('open', False)])
def test_a_rest_that_somebody_asked_for_can_be_told_from_others(oak, messages, hours, asked):
    node(oak, messages, activity='resting', because='person', hours=hours)
    assert told(oak)['rest_asked'] is asked
    assert told(oak, 200.0)['rest_asked'] is False  # nobody knows any more


@pytest.mark.parametrize(('level', 'colour'), [(b'\x00', 'green'), (1, 'yellow'), (b'\x02', 'red')])
def test_a_node_that_is_not_well_colours_the_robot(oak, messages, level, colour):
    node(oak, messages, level, activity='walking')
    assert told(oak)['colour'] == colour


def test_stop_is_red_with_the_sentence_of_the_arbiter(oak, messages):
    oak.receive('oak', 'driver', 100.0, messages.status(
        'driver', 2, 'STOP: asked for, since noon', driver='stop', stop='asked for'))  # fmt: skip
    found = told(oak)
    assert (found['word'], found['colour'], found['stopped']) == ('stopped', 'red', True)
    assert found['sentence'] == 'STOP: asked for, since noon'
    assert found['standstill'] is True


def test_a_hand_that_was_let_go_is_red(oak, messages):
    oak.receive('oak', 'driver', 100.0, messages.status(
        'driver', 1, 'manual fell silent', driver='manual', stop='', lost='manual'))  # fmt: skip
    assert (told(oak)['word'], told(oak)['colour']) == ('stopped', 'red')


def test_a_robot_under_a_hand_is_driven(oak, messages):
    oak.receive('oak', 'driver', 100.0, messages.status('driver', 0, 'manual drives',
                                                        driver='manual', stop=''))  # fmt: skip
    assert told(oak)['word'] == 'driven'
    assert not told(oak)['stopped']


def test_old_data_is_red_and_says_so(oak, messages):
    assert told(oak, 101.9)['colour'] != 'red'
    oak.receive('oak', 'turrets/state', 102.5, messages.turrets())
    found = told(oak, 102.6)
    assert found['colour'] == 'red'
    assert 'pose is 3 s old' in found['sentence']
    found = told(oak, 110.0)
    assert (found['word'], found['colour'], found['sentence']) == (
        'silent',
        'red',
        'no data for 8 s',
    )


def test_a_node_that_fell_silent_counts_no_more(oak, messages):
    node(oak, messages, activity='walking')
    assert told(oak)['word'] == 'walking'
    for topic, message in (('turrets/state', messages.turrets(rates=(0.0, 0.0, 0.0))),
                           ('pose', messages.pose())):  # fmt: skip
        oak.receive('oak', topic, 120.0, message)
    found = told(oak, 120.5)
    assert found['word'] != 'walking'
    assert found['colour'] == 'yellow'


def test_moving_and_standing_are_measured(oak, messages):
    assert (told(oak)['moving'], told(oak)['standstill']) == (False, True)
    oak.receive('oak', 'turrets/state', 100.2, messages.turrets(rates=(0.0, 0.0, 0.5)))
    assert (told(oak)['moving'], told(oak)['standstill']) == (True, False)
    oak.receive('oak', 'turrets/state', 100.3, messages.turrets(rates=(0.0, 0.0, float('nan'))))
    assert (told(oak)['moving'], told(oak)['standstill']) == (False, False)


def test_it_is_told_since_when_the_word_holds(oak, messages):
    node(oak, messages, activity='resting')
    assert told(oak, 100.5)['since'] == 100.5
    assert told(oak, 101.0)['since'] == 100.5
