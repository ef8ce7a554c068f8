"""An act has come true when the robot reports it, and not before."""

from __future__ import annotations

from agv_motion.dashboard.core.board import Board
from agv_motion.dashboard.core.outcomes import is_done


def driver(messages, stop='', lock=''):
    return messages.status('driver', 0, '', driver='agent', stop=stop, lock=lock)


def done(board, action, since, **arguments):
    return is_done(board.robots['oak'], action, arguments, since, since + 1.0)


def test_stop_needs_the_word_of_the_arbiter_and_wheels_measured_since(messages):
    board = Board()
    standing = messages.turrets(rates=(0.0, 0.0, 0.0))
    board.receive('oak', 'driver', 10.0, driver(messages, stop='asked for'))
    board.receive('oak', 'turrets/state', 9.0, standing)
    assert done(board, 'stop', 9.5) is False  # measured before it was asked
    board.receive('oak', 'turrets/state', 10.0, messages.turrets(rates=(0.0, 0.1, 0.0)))
    assert done(board, 'stop', 9.5) is False
    board.receive('oak', 'turrets/state', 10.1, standing)
    assert done(board, 'stop', 9.5) is True
    board.receive('oak', 'driver', 10.2, driver(messages))
    assert done(board, 'stop', 9.5) is False
    assert done(board, 'release', 9.5) is True


def test_stop_without_an_arbiter_needs_the_wheels(messages):
    board = Board()
    board.receive('oak', 'turrets/state', 10.0, messages.turrets())
    assert done(board, 'stop', 9.5) is False
    board.receive('oak', 'turrets/state', 10.1, messages.turrets(rates=(0.0, 0.0, 0.0)))
    assert done(board, 'stop', 9.5) is True


def test_a_pause_is_told_by_the_activity(messages):
    board = Board()
    board.robot('oak')
    assert done(board, 'pause', 9.5) is None  # nobody tells: the answer must do
    for at, activity in ((9.0, 'paused'), (9.8, 'walking'), (11.0, 'paused')):
        status = messages.status('/oak/motion_generator', activity=activity)
        board.receive('', 'diagnostics', at, messages.diagnostics(status))
        board.look(at)
        assert done(board, 'pause', 9.5) is (at == 11.0)
    assert done(board, 'resume', 9.5) is False


def test_a_lock_and_a_goal_are_seen(messages):
    board = Board()
    board.receive('oak', 'driver', 10.0, driver(messages, lock='manual'))
    assert done(board, 'lock', 9.5) is True
    assert done(board, 'unlock', 9.5) is False
    assert done(board, 'lock', 10.5) is False  # told before it was asked
    board.receive('oak', 'goal', 10.0, messages.goal(3.0, 4.0))
    assert done(board, 'goal', 9.5, x=3.0, y=4.0) is True
    assert done(board, 'goal', 9.5, x=3.0, y=4.1) is False
    board.receive('oak', 'pose', 10.0, messages.pose(3.1, 4.0))
    assert done(board, 'pose', 9.5, x=3.0, y=4.0) is True
    assert done(board, 'pose', 10.5, x=3.0, y=4.0) is False
