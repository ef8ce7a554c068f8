"""The three signals: measured, by half, by the mean of the others, or rest with the reason."""

from __future__ import annotations

import pytest

from agv_motion.probe.loss import LossStep, SapFlowEstimate
from agv_motion.probe.probe import ProbeReading
from agv_motion.probe.quality import Quality
from agv_motion.probe.signals import signals_of

CHOSEN = (0, 1, 2)


def measured(flow):
    return ProbeReading(
        0.0, 18.0, Quality.GOOD, 20.0, 0.1, 1e-5, flow, SapFlowEstimate(flow, LossStep.MEASURED)
    )


def lost(flow, step, quality=Quality.OFF):
    return ProbeReading(0.0, 0.1, quality, 20.0, None, None, None, SapFlowEstimate(flow, step))


def test_what_is_measured_is_told():
    told = signals_of((2, 0, 1), [measured(0.1), measured(0.2), measured(0.3)], 3)
    assert told == ((0.3, 0.1, 0.2), '', '')


@pytest.mark.parametrize('step', [LossStep.HELD, LossStep.TREND])
def test_what_stands_in_is_told_as_it_is(step):
    told = signals_of(CHOSEN, [measured(0.1), lost(0.7, step), measured(0.3)], 3)
    assert told.values == (0.1, 0.7, 0.3)
    assert told.losses == f'probe_2 is off: {step.value}'


def test_what_is_usual_counts_by_half_towards_what_moves_nothing():
    """Half of 0.8 of speed; 0.5 + half of 0.3 of rotation, which stands at 0.5."""
    usual = lost(0.8, LossStep.CLIMATOLOGY)
    told = signals_of(CHOSEN, [usual, usual, usual], 3)
    assert told.values == pytest.approx((0.4, 0.65, 0.65))


def test_at_the_end_of_the_ladder_the_tree_rests_and_says_why():
    gone = lost(None, LossStep.LOST, Quality.NOISE)
    assert signals_of(CHOSEN, [measured(0.1), gone, measured(0.3)], 3) == (
        (), 'probe_2 is noise', '',
    )  # fmt: skip
    assert signals_of(CHOSEN, [measured(0.1), None, measured(0.3)], 3).doubt == (
        'probe_2 has given no reading yet'
    )
    learning = ProbeReading(0.0, 18.0, Quality.GOOD, None, None, None, None)
    assert signals_of(CHOSEN, [measured(0.1), learning, measured(0.3)], 3).doubt == (
        'probe_2 is learning its zero flow and range'
    )


def test_two_of_three_are_enough_where_asked_for():
    gone = lost(None, LossStep.LOST)
    told = signals_of(CHOSEN, [measured(0.2), gone, measured(0.4)], 2)
    assert told.values == pytest.approx((0.2, 0.3, 0.4))
    assert told.losses == 'probe_2 is off: the mean of the others'
    held = lost(0.4, LossStep.HELD)
    assert signals_of(CHOSEN, [measured(0.2), gone, held], 2).doubt == 'probe_2 is off'
    assert signals_of(CHOSEN, [measured(0.2), gone, gone], 2).doubt == 'probe_2 is off'
