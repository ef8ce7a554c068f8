"""The ladder of a lost probe: each step by hand, in order, and back at once."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.probe.loss import DayCourse, LossLadder, LossParameters, LossStep, SapFlowEstimate
from agv_motion.probe.noise import DOUBTFUL

HOUR, DAY = 3600.0, 86400.0
LADDER = LossParameters(hold=900.0, trend=1800.0, climatology=3600.0)
NOON = 12 * HOUR


def rising(parameters=LADDER, days=1, step=900.0):
    """Return a ladder that knows days of 0.25, and then an hour that rises by 0.1 to 0.5."""
    ladder = LossLadder(parameters)
    for k in range(int(days * DAY / step)):
        ladder.update(k * step, 0.25)
    for k in range(int(HOUR / step) + 1):
        ladder.update(days * DAY + NOON - HOUR + k * step, 0.4 + 0.1 * k * step / HOUR)
    return ladder, days * DAY + NOON


@pytest.mark.parametrize(
    ('after', 'value', 'step'),
    [
        (1.0, 0.5, LossStep.HELD),
        (900.0, 0.5, LossStep.HELD),
        (900.0 + 900.0, 0.525, LossStep.TREND),
        (900.0 + 1800.0, 0.55, LossStep.TREND),
        (2701.0, 0.25, LossStep.CLIMATOLOGY),
        (6300.0, 0.25, LossStep.CLIMATOLOGY),
        (6301.0, None, LossStep.LOST),
    ],
)
def test_each_step_by_hand(after, value, step):
    ladder, noon = rising()
    told = ladder.update(noon + after, None)
    assert told.step is step
    assert told.value is None if value is None else told.value == pytest.approx(value, abs=1e-12)


@pytest.mark.parametrize(('readings', 'known'), [(DOUBTFUL + 2, False), (DOUBTFUL + 3, True)])
def test_what_may_yet_prove_noise_is_not_in_the_course(readings, known):
    """All are old: into the course go hours that are over, before those in doubt."""
    ladder = LossLadder(LADDER)
    for k in range(readings):
        ladder.update(7 * HOUR * k, 0.25)
    assert (ladder.course.at(0.0) is not None) == known


def test_all_zero_rests_at_once_and_what_comes_back_counts_at_once():
    ladder, noon = rising(LossParameters())
    assert ladder.update(noon + 1.0, None) == SapFlowEstimate(None, LossStep.LOST)
    assert ladder.update(noon + 2.0, 0.3) == SapFlowEstimate(0.3, LossStep.MEASURED)


@pytest.mark.parametrize('name', ['hold', 'trend', 'climatology'])
def test_each_step_may_be_left_out(name):
    given = {'hold': 900.0, 'trend': 900.0, 'climatology': 900.0} | {name: 0.0}
    ladder, noon = rising(LossParameters(**given))
    steps = {ladder.update(noon + k * 100.0, None).step for k in range(1, 40)}
    assert len(steps) == 3
    assert {'hold': LossStep.HELD, 'trend': LossStep.TREND}.get(
        name, LossStep.CLIMATOLOGY
    ) not in steps


@given(st.lists(st.floats(0.0, 1.0), min_size=1, max_size=12), st.floats(0.0, 9000.0))
def test_what_stands_in_is_a_share(flows, after):
    ladder = LossLadder(LADDER)
    for k, flow in enumerate(flows):
        ladder.update(k * 300.0, flow)
    value = ladder.update((len(flows) - 1) * 300.0 + after, None).value
    assert value is None or 0.0 <= value <= 1.0


def test_what_was_never_measured_has_no_ladder():
    ladder = LossLadder(LADDER)
    assert ladder.update(10.0, None).step is LossStep.LOST
    ladder.update(20.0, 0.5)
    assert ladder.update(10.0, None).step is LossStep.LOST  # a clock set back
    assert ladder.update(30.0, None).step is LossStep.LOST  # and what was before is no guide


def test_noise_that_was_believed_is_taken_back():
    ladder, noon = rising()
    ladder.update(noon + 10.0, 0.9)
    ladder.update(noon + 20.0, 0.1)
    ladder.distrust(noon + 10.0)
    assert ladder.update(noon + 30.0, None) == SapFlowEstimate(0.5, LossStep.HELD)
    ladder.distrust(0.0)
    assert ladder.update(noon + 40.0, None).step is LossStep.LOST


def test_an_hour_is_known_when_the_next_has_begun_and_no_other_is():
    course = DayCourse(2)
    for quarter, flow in enumerate((0.1, 0.2, 0.6)):
        course.add(NOON + quarter * 900.0, flow)
    assert course.state() == []
    course.add(NOON + HOUR, 0.9)
    assert course.state() == [[12, pytest.approx(0.3)]]
    assert course.at(0.0) is None


def test_a_course_takes_up_the_hours_of_a_day_that_have_values():
    course = DayCourse(2)
    course.restore([[24, 0.5], [-1, 0.5], [0, 0.5], [23, 0.1, 0.2, 1.0], [5]])
    assert course.state() == [[0, 0.5], [23, 0.2, 1.0]]


def test_the_course_learns_what_was_measured_six_hours_ago():
    ladder = LossLadder(LADDER)
    for quarter in range(8 * 4 + 1):
        ladder.update(quarter * 900.0, 0.25)
    assert ladder.course.state() == [[0, 0.25]]
    ladder.update(8 * HOUR + 900.0, 0.25)
    assert ladder.course.state() == [[0, 0.25], [1, 0.25]]


def test_the_course_of_the_day_is_the_mean_of_the_last_days():
    course = DayCourse(2)
    for day, flow in enumerate((0.9, 0.2, 0.4)):
        for quarter in range(4):
            course.add(day * DAY + NOON + quarter * 900.0, flow + 0.01 * quarter)
        course.add(day * DAY + NOON + HOUR, 0.0)
    assert course.at(5 * DAY + NOON + 1234.0) == pytest.approx((0.215 + 0.415) / 2.0)
    assert course.at(NOON - 1.0) is None
    again = DayCourse(2)
    again.restore(course.state())
    assert again.at(NOON) == course.at(NOON)


@pytest.mark.parametrize(
    'state',
    [
        None,
        [[1, 2.0]],
        [['x', 0.5]],
        [[1, float('nan')]],
        [5],
        7,
        [[1, 0.5, 2.0]],
        [[1, 0.5], [2, -0.1]],
    ],
)
def test_a_course_that_is_none_is_refused(state):
    with pytest.raises(ConfigurationError, match='delete the state file'):
        DayCourse(2).restore(state)


@pytest.mark.parametrize('change', [{'hold': -1.0}, {'enough': 1}, {'climatology_days': 0}])
def test_steps_that_make_no_sense_are_refused(change):
    with pytest.raises(ConfigurationError, match=next(iter(change))):
        LossParameters(**change)


@pytest.mark.parametrize('name', ['hold', 'trend', 'climatology'])
def test_each_step_alone_stands_in(name):
    assert LossParameters(**{name: 1.0}).stands_in
    assert not LossParameters().stands_in
