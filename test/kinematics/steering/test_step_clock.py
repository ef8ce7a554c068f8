"""When a step is due: on time, after a gap, after a clock that jumped."""

from __future__ import annotations

import pytest

from agv_motion.kinematics.steering.step_clock import StepClock


@pytest.mark.parametrize(
    ('passed', 'step'),
    [(0.0, None), (0.05, None), (0.06, 0.06), (0.19, 0.19), (0.21, 0.1), (50.0, 0.1), (-0.01, 0.1)],
)
def test_a_step_is_as_long_as_the_time_that_passed_unless_that_cannot_be(passed, step):
    clock = StepClock(0.1)
    assert clock.elapsed(7.0, 0.05) == 0.1
    found = clock.elapsed(7.0 + passed, 0.05)
    assert found is None if step is None else found == pytest.approx(step)


def test_a_step_that_is_not_due_does_not_count():
    clock = StepClock(0.1)
    clock.elapsed(0.0, 0.05)
    assert clock.elapsed(0.04, 0.05) is None
    assert clock.elapsed(0.08, 0.05) == pytest.approx(0.08)
    assert clock.elapsed(0.14, 0.05) == pytest.approx(0.06)
