"""One order: taken, ended once, and never by what belongs to the one before."""

from __future__ import annotations

import pytest

from agv_motion.client.task import LOST_ORDER, Outcome, Task

ENDS = {'arrived': Outcome.SUCCEEDED, 'aborted': Outcome.CANCELLED, 'lost': Outcome.FAILED}


@pytest.fixture
def task():
    return Task(ENDS, sent=100.0)


@pytest.mark.parametrize(('word', 'outcome'), ENDS.items())
def test_a_state_ends_it_by_its_first_words(task, word, outcome):
    task.accept()
    task.tell('driving: arrived is not said')
    assert not task.ended
    task.tell(f'{word}: because')
    assert task.result == (outcome, f'{word}: because')
    assert task.result.succeeded is (outcome is Outcome.SUCCEEDED)


def test_what_was_said_before_it_was_taken_does_not_end_it(task):
    task.tell('arrived')
    task.accept()
    task.look(100.5)
    assert not task.ended
    task.tell('driving')
    task.look(200.0)
    assert not task.ended


def test_an_end_that_overtook_the_acceptance_counts_after_a_while(task):
    task.tell('arrived')
    task.accept()
    task.look(100.0 + LOST_ORDER + 0.1)
    assert task.result.outcome is Outcome.SUCCEEDED


def test_another_order_cancels_it_and_the_first_end_counts(task):
    task.accept()
    task.accept()
    assert task.result == (Outcome.CANCELLED, 'another order took its place')
    task.tell('arrived')
    task.end(Outcome.FAILED, 'too late')
    assert task.result.outcome is Outcome.CANCELLED
