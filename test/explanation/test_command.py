"""What comes to the wheels: who drives, who holds them, and numbers that are none."""

from __future__ import annotations

import pytest

from agv_motion.explanation.link import Level


def driven(level, sentence, **values):
    def change(robot):
        robot.driver = level, sentence, {'driver': 'none', 'stop': '', 'lock': '', 'lost': ''}
        robot.driver[2].update(values)
        if level:
            robot.rest('goal', 'walking to (3, 4)', 'walking')

    return change


CASES = {
    'STOP': (driven(2, 'STOP: by maria, since 14:00; release it', driver='stop',
                    stop='by maria, since 14:00'), 'cmd_vel',
             'STOP holds: by maria, since 14:00: release it: on the page', Level.ERROR),
    'driven by hand': (driven(0, 'manual drives', driver='manual'), 'cmd_vel', 'manual drives',
                       Level.OK),
    'a dead-man let go': (driven(1, 'manual fell silent while it drove', driver='manual',
                                 lost='manual'), 'cmd_vel', 'stands for manual', Level.WARN),
    'agent drives': (driven(0, 'agent drives', driver='agent'), 'decision',
                     'wheels turn: walking to (3, 4)', Level.OK),
}  # fmt: skip


@pytest.mark.parametrize('case', CASES)
def test_the_first_cause_and_what_to_do(judge, case):
    judge(*CASES[case])


@pytest.mark.parametrize('number', ['nan', 'inf', 'x', ''])
def test_what_is_no_number_is_told_as_such(robot, number, link):
    robot.set_wheels(**{'vx [m/s]': number, 'residual [m/s]': number})
    chain = robot.tell()
    assert link(chain, 'cmd_vel').clause == 'cmd_vel holds no numbers'
    assert link(chain, 'wheels').sentence == 'wheels turn, the fastest at 0.0103 m/s'
