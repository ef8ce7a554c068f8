"""What the probes tell: which is bad, and whether that matters."""

from __future__ import annotations

from agv_motion.explanation.link import Level


def test_a_probe_that_is_no_signal_is_told_and_is_no_cause(robot):
    robot.probes = 0, 'all probes believable', robot.probes[2] | {
        'probe_4 condition': 'stuck', 'probe_4 signal': '',
    }  # fmt: skip
    chain = robot.tell()
    assert chain.links[-1].sentence == 'probe 4 is stuck'
    assert {link.level for link in chain.links[:-1]} == {Level.OK}
    assert chain.headline == 'wheels turn: walking to (3, 4)'


def test_a_sap_flow_that_is_silent_though_no_probe_is_bad(robot):
    robot.rest('sap flow', 'resting: no sap flow', 'stopped')
    robot.probes = 1, 'resting: no reading for 90 s', robot.probes[2] | {
        'source silent [s]': '90.0',
    }  # fmt: skip
    chain = robot.tell()
    assert chain.cause.name == 'sap flow'
    assert 'stopped: no reading for 90 s: look at the logger' in chain.headline
