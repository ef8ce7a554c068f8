"""What the node that decides tells: why a tree rests, and what can be done about it."""

from __future__ import annotations

import pytest

from agv_motion.explanation.link import Level


def rests(because, words='as it says', activity='resting'):
    return lambda robot: robot.rest(because, words, activity)


CASES = {
    'asleep': (rests('sap', 'resting: the sap stands'), 'decision', 'the sap stands', Level.OK),
    'closed': (rests('hours', 'resting: closed until Tue 10:00', 'closed'), 'decision',
               'closed until Tue 10:00', Level.OK),
    'asked': (rests('person', 'resting until Mon 14:30, as asked'), 'decision',
              'as asked: whoever asked for it can end it', Level.OK),
    'paused': (rests('person', 'paused', 'paused'), 'decision', 'paused: whoever', Level.WARN),
    'blocked': (rests('motion', 'blocked: told to go 0.6 m', 'blocked'), 'decision',
                'blocked: told to go 0.6 m: clear its way', Level.ERROR),
    'another tree': (rests('others', 'walking to (3, 4): waits for ash', 'waiting'), 'decision',
                     'waits for ash: wait; if it lasts', Level.WARN),
    'outside': (rests('zone', 'stopped: the tree lies outside', 'stopped'), 'decision',
                'lies outside: drive it to free floor', Level.ERROR),
}  # fmt: skip


@pytest.mark.parametrize('case', CASES)
def test_the_first_cause_and_what_to_do(judge, case):
    judge(*CASES[case])
