"""What the wheels tell: held, silent, or told to turn and standing."""

from __future__ import annotations

import pytest

from agv_motion.explanation.link import Level


def held(by, words):
    def change(robot):
        robot.rest('goal', 'walking to (3, 4)', 'walking')
        robot.set_wheels(2, f'stopped: {words}', **{'held by': by})

    return change


CASES = {
    'held by a person': (held('person', 'by request'), 'wheels', 'by request: let them go',
                         Level.ERROR),
    'turrets fight': (held('fight', 'turrets fight by 0.0300 m/s'), 'wheels',
                      'look at the turrets', Level.ERROR),
    'encoders gone': (held('encoders', 'turrets/state is lost'), 'wheels', 'look at the encoders',
                      Level.ERROR),
}  # fmt: skip


@pytest.mark.parametrize('case', CASES)
def test_the_first_cause_and_what_to_do(judge, case):
    judge(*CASES[case])


def test_encoders_that_fall_silent(robot):
    robot.set_wheels(**{'encoders age [s]': '2.5'})
    chain = robot.tell()
    assert chain.headline == (
        'the encoders are silent: look at the encoders, their cable and their power'
    )
    assert chain.links[0].sentence == 'the encoders are silent for 2.5 s'


def test_wheels_that_do_not_turn_though_told_to(robot):
    """They may need a few seconds for it, and turrets turn first."""
    robot.set_wheels(**{'wheel speed [m/s]': '0.0', 'limited by': 'turning the turrets'})
    assert robot.tell().headline == 'wheels do not turn yet: walking to (3, 4)'
    for _ in range(12):
        chain = robot.tell()
    assert chain.headline.startswith('wheels stand though told to turn: look at the motors')
    assert chain.level is Level.ERROR
    robot.set_wheels(**{'commanded wheel speed [m/s]': '0.0'})
    assert robot.tell().level is Level.OK
