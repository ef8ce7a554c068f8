"""The chain of one robot: from whatever is wrong to its first cause, and what to do about it."""

from __future__ import annotations

import pytest

from agv_motion.explanation.link import Level


def test_a_tree_that_walks(robot):
    chain = robot.tell()
    assert chain.headline == 'wheels turn: walking to (3, 4)'
    assert [link.name for link in chain.links] == [
        'wheels', 'cmd_vel', 'decision', 'pose', 'sap flow', 'probe_1', 'probe_2', 'probe_3',
    ]  # fmt: skip
    assert {link.level for link in chain.links} == {Level.OK}
    assert chain.level is Level.OK


def test_a_probe_that_is_off_is_followed_from_the_wheels(robot):
    """12:02 UTC is 14:02 in Paris."""
    robot.rest('probes', 'resting: a probe cannot be believed')
    robot.probes = 1, 'resting: probe_2 is off', robot.probes[2] | {
        'probe_2 condition': 'off', 'probe_2 since [s]': '1434369720.0',
    }  # fmt: skip
    chain = robot.tell()
    assert chain.headline == (
        'wheels stand: cmd_vel is zero: resting: probe 2 is off since 14:02: look at its heater'
    )
    assert chain.cause.name == 'probe_2'
    assert chain.cause.since == 1434369720.0
    assert [link.name for link in chain.way()] == [
        'wheels', 'cmd_vel', 'decision', 'sap flow', 'probe_2',
    ]  # fmt: skip
    assert chain.level is Level.WARN


GONE = {
    'wheel_kinematics': ('wheels', 'wheel_kinematics is silent: see whether wheel_kinematics'),
    'motion_generator': ('decision', 'motion_generator is silent: see whether'),
    'driver': ('cmd_vel', 'the arbiter is silent: see whether arbiter still runs'),
}


@pytest.mark.parametrize('name', GONE)
def test_who_falls_silent_is_the_cause(robot, name):
    cause, words = GONE[name]
    robot.driver = 0, 'agent drives', {'driver': 'agent'}
    robot.tell()
    robot.silent.add(name)
    for _ in range(10):
        chain = robot.tell()
    assert chain.cause.name == cause
    assert words in chain.headline
    assert chain.level is Level.ERROR


@pytest.mark.parametrize('part', ['wheels', 'localization', 'probes'])
def test_a_clock_that_cannot_be_believed_is_no_fault_of_encoders_or_probes(robot, part, link):
    level, _, values = getattr(robot, part)
    told = values | {'clock fault': 'the clock leapt ahead by 2.0 s', 'odom': 'lost'}
    setattr(robot, part, (2, 'the clock leapt ahead by 2.0 s: standing still', told))
    found = link(robot.tell(), {'localization': 'pose', 'probes': 'sap flow'}.get(part, part))
    assert (found.level, found.clause) == (Level.ERROR, 'the clock leapt ahead by 2.0 s')
    assert found.remedy.startswith('look at the clock')
    assert level == 0


def test_since_when_a_link_is_so(robot, link):
    """The decision tells it; of the wheels the explainer remembers it."""
    robot.tell()
    for _ in range(4):
        chain = robot.tell()
    assert link(chain, 'wheels').since == 1434369600.5
    assert link(chain, 'decision').since == 1434369540.0
    robot.rest('sap', 'resting: the sap stands')
    assert link(robot.tell(), 'wheels').since == 1434369603.0


def test_of_a_robot_that_says_nothing_nothing_is_known(robot):
    chain = robot.chain()
    assert chain.headline == (
        'nothing is heard of the wheels: start their node: one of wheel_kinematics, '
        'differential_kinematics, omni_kinematics'
    )
    assert chain.level is Level.STALE
