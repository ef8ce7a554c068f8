"""An answer of another thread ends the future once, with what came of it or why nothing did."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import pytest

pytest.importorskip('rclpy')

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.nodes.promise import guarded, promise


def answered(run_apart, *answers):
    """Return what a future ends with, that another thread answers."""

    async def ask():
        future, answer = promise()
        with ThreadPoolExecutor(1) as pool:
            for one in answers:
                pool.submit(answer, one)
        return await future

    return run_apart(ask())


def test_the_first_answer_counts(run_apart):
    assert answered(run_apart, 'yes', 'no', SignalError('late')) == 'yes'
    with pytest.raises(SignalError, match='no message'):
        answered(run_apart, SignalError('no message'), 'yes')


def test_who_answers_when_nobody_waits_any_more_is_not_troubled(run_apart):
    async def ask():
        return promise()[1]

    run_apart(ask())('late')


def fail(error):
    raise error


@pytest.mark.parametrize(
    ('act', 'done', 'told'),
    [
        (lambda: False, False, []),
        (lambda: True, True, []),
        (lambda: fail(SignalError('bad')), True, [(SignalError, 'bad')]),
        (lambda: fail(KeyError('x')), True, [(ConfigurationError, "KeyError: 'x'")]),
    ],
)
def test_errors_of_an_act_end_it_and_are_told(act, done, told):
    answers = []
    assert guarded(act, answers.append)() is done
    assert [(type(one), str(one)) for one in answers] == told
