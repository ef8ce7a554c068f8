"""The chain of one robot: from whatever is wrong to its first cause, and what to do about it."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from agv_motion.explanation import Evidence, Explainer
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


def test_a_probe_that_is_no_signal_is_told_and_is_no_cause(robot):
    robot.probes = 0, 'all probes believable', robot.probes[2] | {
        'probe_4 condition': 'stuck', 'probe_4 signal': '',
    }  # fmt: skip
    chain = robot.tell()
    assert chain.links[-1].sentence == 'probe 4 is stuck'
    assert {link.level for link in chain.links[:-1]} == {Level.OK}
    assert chain.headline == 'wheels turn: walking to (3, 4)'


def rests(because, words='as it says', activity='resting'):
    return lambda robot: robot.rest(because, words, activity)


def held(by, words):
    def change(robot):
        robot.rest('goal', 'walking to (3, 4)', 'walking')
        robot.set_wheels(2, f'stopped: {words}', **{'held by': by})

    return change


def driven(level, sentence, **values):
    def change(robot):
        robot.driver = level, sentence, {'driver': 'none', 'stop': '', 'lock': '', 'lost': ''}
        robot.driver[2].update(values)
        if level:
            robot.rest('goal', 'walking to (3, 4)', 'walking')

    return change


def silent(*names):
    return lambda robot: robot.silent.update(names)


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
    'held by a person': (held('person', 'by request'), 'wheels', 'by request: let them go',
                         Level.ERROR),
    'turrets fight': (held('fight', 'turrets fight by 0.0300 m/s'), 'wheels',
                      'look at the turrets', Level.ERROR),
    'encoders gone': (held('encoders', 'turrets/state is lost'), 'wheels', 'look at the encoders',
                      Level.ERROR),
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
def test_the_first_cause_and_what_to_do(robot, case):
    change, cause, words, level = CASES[case]
    change(robot)
    chain = robot.tell()
    assert chain.cause.name == cause
    assert words in chain.headline
    assert chain.level is level


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


def test_encoders_that_fall_silent(robot):
    robot.set_wheels(**{'encoders age [s]': '2.5'})
    chain = robot.tell()
    assert chain.headline == (
        'the encoders are silent: look at the encoders, their cable and their power'
    )
    assert chain.links[0].sentence == 'the encoders are silent for 2.5 s'


def test_a_sap_flow_that_is_silent_though_no_probe_is_bad(robot):
    robot.rest('sap flow', 'resting: no sap flow', 'stopped')
    robot.probes = 1, 'resting: no reading for 90 s', robot.probes[2] | {
        'source silent [s]': '90.0',
    }  # fmt: skip
    chain = robot.tell()
    assert chain.cause.name == 'sap flow'
    assert 'stopped: no reading for 90 s: look at the logger' in chain.headline


def test_a_pose_that_is_not_told(robot):
    robot.rest('pose', 'resting: no pose', 'stopped')
    robot.localization = 2, 'pose not told: position or heading not known yet', {
        'state': 'searching', 'odom': 'fresh', 'pose told': 'no',
    }  # fmt: skip
    chain = robot.tell()
    assert chain.cause.name == 'pose'
    assert chain.headline.endswith(
        'set the pose (localization/set_pose), or let the robot drive a metre'
    )
    robot.localization = 2, 'odom is lost', robot.localization[2] | {'odom': 'lost'}
    assert robot.tell().headline.endswith('look at the encoders: odometry has ended')


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


@pytest.mark.parametrize('number', ['nan', 'inf', 'x', ''])
def test_what_is_no_number_is_told_as_such(robot, number, link):
    robot.set_wheels(**{'vx [m/s]': number, 'residual [m/s]': number})
    chain = robot.tell()
    assert link(chain, 'cmd_vel').clause == 'cmd_vel holds no numbers'
    assert link(chain, 'wheels').sentence == 'wheels turn, the fastest at 0.0103 m/s'


def test_nodes_of_another_robot_and_sentences_decide_nothing(robot, link):
    """The same sentence with another key is another cause."""
    robot.rest('hours', 'resting: a probe cannot be believed', 'closed')
    chain = robot.tell()
    assert chain.cause.name == 'decision'
    robot.evidence.receive(other(), robot.now)
    assert robot.chain() == chain


def other():
    stranger = SimpleNamespace(name='/ash/wheel_kinematics', level=b'\x02', message='x', values=[])
    return SimpleNamespace(status=[stranger])


def test_a_robot_on_two_wheels_has_no_sap():
    evidence = Evidence()
    route = {'activity': 'driving', 'because': 'goal'}
    wheels = {
        'held by': 'nobody', 'encoders age [s]': '0.1', 'wheel speed [m/s]': '0.3',
        'cmd_vel age [s]': '0.1', 'vx [m/s]': '0.3', 'vy [m/s]': '0', 'wz [rad/s]': '0',
    }  # fmt: skip
    told = [said('/route_follower', 'following', route),
            said('/differential_kinematics', 'driving', wheels)]  # fmt: skip
    evidence.receive(SimpleNamespace(status=told), 5.0)
    chain = Explainer().explain(evidence, 5.1, 1000.0)
    assert [link.name for link in chain.links] == ['wheels', 'cmd_vel', 'decision', 'pose']
    assert chain.headline == 'wheels turn: following'
    assert chain.links[3].sentence == 'odometry alone tells where it is'


def said(name, message, values):
    pairs = [SimpleNamespace(key=key, value=value) for key, value in values.items()]
    return SimpleNamespace(name=name, level=0, message=message, values=pairs)
