"""How each probe is, and since when."""

from __future__ import annotations

from math import nan

from agv_motion.probe.condition import ProbeConditions, condition
from agv_motion.probe.probe import ProbeReading
from agv_motion.probe.quality import Quality


def reading(quality=Quality.GOOD, sap_flow=0.5, difference=15.0):
    return ProbeReading(0.0, difference, quality, 18.0, 0.1, 1e-5, sap_flow)


def test_a_probe_is_as_its_quality_or_learns_or_has_said_nothing():
    assert condition(None) == 'no reading'
    assert condition(reading()) == 'good'
    assert condition(reading(sap_flow=None)) == 'learning'
    assert condition(reading(Quality.OFF, None, 0.1)) == 'off'


def test_a_probe_that_never_spoke_has_been_silent_since_the_epoch():
    conditions = ProbeConditions((), 1)
    conditions.update(10.0, [None])
    assert conditions.values([None]) == {
        'probe_1 condition': 'no reading', 'probe_1 since [s]': '0.0', 'probe_1 signal': '',
    }  # fmt: skip


def test_since_when_counts_from_the_last_change():
    conditions = ProbeConditions(('probe_2', 'probe_1', 'probe_2'), 2)
    good, off = reading(), reading(Quality.OFF, None, 0.8)
    for now, second in ((10.0, good), (20.0, off), (30.0, off)):
        conditions.update(now, [good, second])
    values = conditions.values([good, off])
    assert values['probe_1 since [s]'] == '10.0'
    assert values['probe_2 since [s]'] == '20.0'
    assert (values['probe_1 signal'], values['probe_2 condition']) == ('s2', 'off')
    assert values['probe_1 sap flow'] == '0.500'
    assert 'probe_2 sap flow' not in values
    assert values['probe_1 flux density [m/s]'] == '1.0000e-05'
    learning = good._replace(flux_density=None, sap_flow=None)
    assert 'probe_1 flux density [m/s]' not in conditions.values([learning, off])
    assert values['probe_2 dT [K]'] == '0.800'
    assert conditions.values([reading(Quality.MISSING, None, nan), off])['probe_1 dT [K]'] == 'nan'
