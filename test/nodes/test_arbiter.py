"""The arbiter in a graph of this process: the clock is the test's."""

from __future__ import annotations

from itertools import pairwise
from math import inf, nan

import pytest

pytest.importorskip('rclpy')

from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import Twist as TwistMessage
from geometry_msgs.msg import TwistStamped
from std_msgs.msg import Bool
from std_srvs.srv import SetBool

from agv_motion.nodes.arbiter import ArbiterNode
from agv_motion.planar import REST, Twist
from agv_motion.ros.cdr import codec
from agv_motion.ros.diagnosis import ERROR, OK, WARN
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.messages import stamp_of, twist_of
from agv_motion.ros.qos import COMMAND

SECOND = 1_000_000_000
START = 1000 * SECOND
A, B = Twist(0.1, 0.0, 0.2), Twist(-0.3, 0.1, 0.0)
KINDS = {'/cmd_vel': TwistStamped, '/driver': DiagnosticStatus, '/standstill': Bool}


class Trial:
    """An arbiter, messages to it, and what it has said."""

    def __init__(self, **given):
        self.said = {topic: [] for topic in KINDS}
        self.kind = TwistStamped if given.get('stamped', True) else TwistMessage
        self.graph = InProcessGraph(self._record, START)
        self.node = InProcessNode(self.graph, ArbiterNode, given)
        self.graph.start()

    def _record(self, publisher, stamp, data):
        kind = self.kind if publisher.topic == '/cmd_vel' else KINDS[publisher.topic]
        self.said[publisher.topic].append(((stamp - START) / SECOND, codec(kind).decode(data)))

    def say(self, source, seconds, twist=A, *, stamp=None, frame=''):
        message = self.kind()
        if self.kind is TwistStamped:
            message.header.frame_id = frame
            message.header.stamp = stamp_of(self._at(seconds if stamp is None else stamp))
        body = message.twist if self.kind is TwistStamped else message
        body.linear.x, body.linear.y, body.angular.z = twist
        self.feed(source, seconds, message)

    def feed(self, source, seconds, message):
        data = codec(type(message)).encode(message)
        self.graph.feed(f'/cmd_vel/{source}', self._at(seconds), data)

    def keep_saying(self, source, begin, end, twist=A):
        for i in range(round((end - begin) / 0.05)):
            self.say(source, begin + 0.05 * i, twist)

    def until(self, seconds):
        self.graph.run(self._at(seconds))
        self.graph.now = self._at(seconds)

    def ask(self, service, *, data):
        return self.node.port.services[f'~/{service}'][1](SetBool.Request(data=data))

    def hear_of(self, service, seconds, *, data):
        """Tell, as a bag does, what a service was asked; that it was answered asks nothing."""
        request, response = SetBool.Request(data=data), SetBool.Response(success=True)
        for kind, said in ((1, {'request': [request]}), (2, {'response': [response]})):
            event = SetBool.Event(**said)
            event.info.event_type = kind
            told = codec(SetBool.Event).encode(event)
            self.graph.feed(f'/arbiter/{service}/_service_event', self._at(seconds), told)

    @property
    def twist(self):
        """The last twist that was commanded."""
        message = self.said['/cmd_vel'][-1][1]
        return twist_of(message.twist if self.kind is TwistStamped else message)

    @property
    def stands(self):
        """What the wheels were told last."""
        return self.said['/standstill'][-1][1].data

    @property
    def driver(self):
        """What was told last of who drives."""
        return self.said['/driver'][-1][1]

    def value(self, key):
        return {pair.key: pair.value for pair in self.driver.values}[key]

    @staticmethod
    def _at(seconds):
        return START + round(seconds * SECOND)


def test_what_a_driver_says_is_passed_on_at_once_to_the_bit():
    trial = Trial()
    trial.say('agent', 0.03)
    moment, message = trial.said['/cmd_vel'][-1]
    assert (moment, trial.twist, message.header.frame_id) == (0.03, A, 'base_link')
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == (1000, 30_000_000)
    assert (trial.driver.message, trial.driver.level) == ('agent drives', OK)
    assert (trial.driver.name, trial.value('agent')) == ('/arbiter', 'drives, 0.00 s')
    assert not trial.stands


def test_it_commands_zero_where_nobody_drives_and_is_never_silent():
    trial = Trial(rate=10.0)
    trial.until(1.0)
    moments = [moment for moment, _ in trial.said['/cmd_vel']]
    assert all(b - a <= 0.21 for a, b in pairwise([*moments, 1.0]))
    assert trial.twist == REST
    assert trial.driver.message == 'nobody drives: no source speaks'


def test_a_driver_is_repeated_until_its_time_out():
    trial = Trial()
    trial.say('route', 0.0)
    trial.until(0.45)
    assert trial.twist == A
    trial.until(0.75)
    assert trial.twist == REST
    gone = next(moment for moment, m in trial.said['/cmd_vel'] if moment and not any_of(m))
    assert gone <= 0.5 + 0.1


def any_of(message):
    return any(twist_of(message.twist))


def test_who_ranks_higher_drives_and_the_sentence_tells_why_the_other_does_not():
    trial = Trial()
    trial.say('agent', 0.01)
    trial.say('manual', 0.02, B)
    trial.say('agent', 0.03)
    assert trial.twist == B
    assert trial.driver.message == 'manual drives; agent waits: manual comes first'
    assert trial.value('driver') == 'manual'
    assert trial.value('agent').startswith('outranked (manual comes first), ')


@pytest.mark.parametrize(
    'way', ['topic', 'service', 'recorded service', 'a topic with NaN', 'with an old stamp']
)
def test_stop_is_a_zero_and_a_standstill_in_the_same_instant(way):
    trial = Trial()
    trial.say('manual', 0.01)
    trial.until(0.02)
    if way == 'service':
        trial.ask('stop', data=True)
    elif way == 'recorded service':
        trial.hear_of('stop', 0.02, data=True)
    else:
        twist = Twist(nan, inf, 0.0) if 'NaN' in way else REST
        trial.say('stop', 0.02, twist, stamp=-999.0 if 'old' in way else 0.02, frame='anywhere')
    assert trial.said['/cmd_vel'][-1][0] == trial.said['/standstill'][-1][0] == 0.02
    assert (trial.twist, trial.stands, trial.driver.level) == (REST, True, ERROR)
    assert trial.value('driver') == 'stop'
    where = '~/stop' if 'service' in way else 'cmd_vel/stop'
    assert trial.value('stop') == f'asked for by {where}, since 1970-01-01 00:16:40'.replace(
        'by cmd', 'on cmd'
    )


def test_stop_is_released_by_the_service_alone_and_by_who_speaks_anew():
    trial = Trial()
    trial.say('stop', 0.01)
    trial.keep_saying('agent', 0.05, 2.0)
    assert (trial.twist, trial.stands) == (REST, True)
    assert trial.ask('stop', data=False) == 'released: whoever speaks from now on drives'
    assert (trial.twist, trial.stands, trial.value('stop')) == (REST, False, '')
    told = len(trial.said['/standstill'])
    trial.hear_of('stop', 2.1, data=False)
    assert len(trial.said['/standstill']) == told + 1  # wheels may have heard what it did not
    trial.until(2.2)
    assert trial.twist == REST
    trial.say('agent', 2.3)
    assert trial.twist == A


@pytest.mark.parametrize(('stamp', 'counts'), [(0.71, True), (0.69, False), (1.31, False)])
def test_a_manual_twist_counts_by_its_stamp(stamp, counts):
    trial = Trial()
    trial.say('manual', 1.0, stamp=stamp)
    assert trial.twist == (A if counts else REST)
    assert any('stamped' in text for text in trial.graph.complaints) is not counts


def test_the_dead_man_is_judged_from_the_stamp_on():
    trial = Trial()
    trial.say('manual', 1.0, stamp=0.8)
    trial.until(1.05)
    assert trial.twist == A
    trial.until(1.2)
    assert (trial.twist, trial.stands) == (REST, True)


def test_a_dead_man_that_is_let_go_stands_at_once_and_nobody_takes_over():
    trial = Trial()
    trial.keep_saying('agent', 0.0, 0.5, B)
    trial.keep_saying('manual', 0.5, 1.0)
    trial.keep_saying('agent', 1.0, 3.0, B)
    stopped = next(moment for moment, message in trial.said['/standstill'] if message.data)
    assert 1.25 <= stopped <= 1.36  # 0.3 s after 0.95 s, and one look
    assert (trial.twist, trial.stands, trial.driver.level) == (REST, True, WARN)
    assert 'manual fell silent while it drove' in trial.driver.message
    assert trial.value('lost') == 'manual'
    assert trial.ask('lock_manual', data=False) == 'unlocked'
    assert (trial.twist, trial.stands, trial.value('lost')) == (B, False, '')


def test_a_dead_man_that_ends_in_zeros_hands_over():
    trial = Trial()
    trial.keep_saying('manual', 0.0, 0.5)
    trial.keep_saying('manual', 0.5, 0.7, REST)
    trial.keep_saying('agent', 0.7, 1.2, B)
    assert [message.data for _, message in trial.said['/standstill']] == [False]
    assert trial.twist == B


def test_a_burst_of_what_a_stall_held_back_does_not_drive():
    trial = Trial()
    trial.keep_saying('manual', 0.0, 0.5)
    trial.until(2.0)
    for i in range(20):
        trial.say('manual', 2.0 + 0.001 * i, stamp=0.5 + 0.05 * i)
    assert (trial.twist, trial.stands) == (REST, True)


@pytest.mark.parametrize('source', ['manual', 'page', 'route', 'sequence', 'agent'])
def test_a_repeat_and_what_was_overtaken_are_no_news(source):
    trial = Trial()
    trial.say(source, 0.10)
    for i in range(40):
        trial.say(source, 0.15 + 0.05 * i, B, stamp=0.10 if i % 2 else 0.05)
    assert B not in [twist_of(message.twist) for _, message in trial.said['/cmd_vel']]
    assert trial.twist == REST


def test_an_old_zero_stops_but_a_dead_man_needs_news():
    trial = Trial()
    trial.say('manual', 0.1)
    trial.say('manual', 0.11, REST, stamp=0.05)
    assert trial.twist == REST
    assert trial.value('driver') == 'manual'
    trial.say('agent', 0.45, B)
    assert (trial.twist, trial.stands) == (B, False)


@pytest.mark.parametrize('number', [nan, inf, -inf, 1e6])
def test_what_is_no_twist_changes_nothing(number):
    trial = Trial()
    trial.say('agent', 0.1)
    trial.say('agent', 0.2, Twist(number, 0.0, 0.0))
    trial.say('manual', 0.2, Twist(0.0, 0.0, number))
    assert trial.twist == A
    assert sum('refused: cmd_vel/' in text for text in trial.graph.complaints) == 2
    trial.until(1.3)
    assert trial.twist == REST


def test_a_twist_of_another_frame_is_refused_but_a_zero_stops():
    trial = Trial()
    trial.say('agent', 0.1)
    trial.say('agent', 0.2, B, frame='map')
    assert trial.twist == A
    trial.say('agent', 0.3, REST, frame='map')
    trial.until(0.45)
    assert trial.twist == REST


def test_a_lock_holds_the_robot_for_whom_it_is():
    trial = Trial()
    trial.say('agent', 0.01)
    assert trial.ask('lock_manual', data=True) == 'locked: nothing below it drives'
    assert (trial.twist, trial.stands, trial.value('lock')) == (REST, False, 'manual')
    trial.say('agent', 0.1)
    assert trial.twist == REST
    assert 'agent waits: manual is locked until released' in trial.driver.message
    trial.say('manual', 0.2, B)
    assert trial.twist == B
    trial.say('manual', 0.3, REST)
    trial.say('agent', 0.7)
    assert (trial.twist, trial.stands) == (REST, False)
    trial.ask('lock_manual', data=False)
    assert trial.twist == A


@pytest.mark.parametrize('source', ['page', 'route', 'sequence', 'agent'])
def test_every_driver_has_a_lock(source):
    trial = Trial()
    trial.ask(f'lock_{source}', data=True)
    assert (trial.value('lock'), trial.value('driver')) == (source, source)


def test_what_holds_is_kept_over_a_restart(tmp_path):
    path = tmp_path / 'arbiter.json'
    before = Trial(state_file=str(path))
    before.say('stop', 0.1)
    before.ask('lock_route', data=True)
    after = Trial(state_file=str(path))
    assert (after.stands, after.value('lock')) == (True, 'route')
    assert after.value('stop') == 'asked for on cmd_vel/stop, since 1970-01-01 00:16:40'
    after.say('manual', 0.1)
    assert after.twist == REST
    after.ask('stop', data=False)
    third = Trial(state_file=str(path))
    assert (third.stands, third.value('lock')) == (False, 'route')


def test_a_dead_man_that_was_let_go_is_so_after_a_restart(tmp_path):
    before = Trial(state_file=str(tmp_path / 'a'))
    before.say('manual', 0.1)
    before.until(1.0)
    after = Trial(state_file=str(tmp_path / 'a'))
    after.say('agent', 0.1)
    assert (after.twist, after.stands) == (REST, True)


def test_a_damaged_file_holds_stop_now_and_after_the_next_restart(tmp_path):
    path = tmp_path / 'arbiter.json'
    path.write_text('{')
    for _ in range(2):
        trial = Trial(state_file=str(path))
        trial.say('agent', 0.1)
        assert (trial.twist, trial.stands) == (REST, True)
        assert 'could not be used' in trial.value('stop')
    assert (tmp_path / 'arbiter.json.unusable').read_text() == '{'


def test_a_disk_that_does_not_take_it_is_told_and_tried_again(tmp_path):
    folder = tmp_path / 'state'
    folder.write_text('no folder')
    trial = Trial(state_file=str(folder / 'arbiter.json'))
    trial.say('stop', 0.1)
    assert (trial.stands, trial.node.plain.diagnose().level) == (True, ERROR)
    assert 'cannot keep STOP' in trial.node.plain.diagnose().values['state_file']
    folder.unlink()
    trial.until(2.5)
    assert 'state_file' not in trial.node.plain.diagnose().values
    assert Trial(state_file=str(folder / 'arbiter.json')).stands


def test_deactivated_and_active_again_it_stands_until_somebody_speaks():
    trial = Trial()
    trial.say('agent', 0.1)
    trial.node.deactivate()
    assert (trial.twist, trial.stands) == (REST, False)
    assert 'not active' in trial.driver.message
    trial.node.activate()
    trial.until(0.3)
    assert (trial.twist, trial.value('driver')) == (REST, 'none')
    trial.say('agent', 0.4)
    assert trial.twist == A


def test_stop_outlasts_a_deactivation_and_a_dead_man_that_drove_is_lost():
    trial = Trial()
    trial.say('manual', 0.1)
    trial.node.deactivate()
    trial.node.activate()
    assert (trial.stands, trial.value('lost')) == (True, 'manual')
    trial.ask('stop', data=True)
    trial.node.deactivate()
    trial.node.activate()
    trial.say('agent', 0.2)
    assert (trial.twist, trial.stands, trial.value('driver')) == (REST, True, 'stop')


def test_a_clock_with_a_fault_stands_and_everybody_has_to_speak_anew():
    trial = Trial()
    trial.say('agent', 0.1)
    trial.node.port.clock.fault = 'the clock leapt'
    trial.say('agent', 0.15)
    trial.until(0.3)
    assert trial.twist == REST
    trial.say('stop', 0.35)
    assert trial.stands
    trial.node.port.clock.fault = ''
    trial.ask('stop', data=False)
    trial.until(0.5)
    assert trial.twist == REST


def test_limits_ramp_a_change_of_driver_and_stop_passes_them():
    trial = Trial(rate=10.0, **{'limits.linear_acceleration': 1.0, 'limits.turn_rate': 0.1})
    trial.keep_saying('agent', 0.0, 1.0, Twist(0.5, 0.0, 0.2))
    assert trial.twist == pytest.approx((0.25, 0.0, 0.1))  # all of it slower by one factor
    trial.keep_saying('manual', 1.0, 1.1, Twist(-0.05, 0.0, 0.0))
    steps = [message.twist.linear.x for moment, message in trial.said['/cmd_vel'] if moment > 0.9]
    assert steps[-1] == pytest.approx(0.15)
    assert max(a - b for a, b in pairwise(steps)) <= 0.05 + 1e-9
    trial.say('stop', 1.15)
    assert trial.twist == REST


def test_a_ramp_goes_on_however_seldom_a_driver_speaks():
    trial = Trial(rate=10.0, **{'limits.linear_acceleration': 1.0})
    trial.say('agent', 0.0, Twist(0.5, 0.0, 0.0))
    trial.until(0.65)
    assert trial.twist == (0.5, 0.0, 0.0)


def test_without_stamps_a_twist_means_now():
    trial = Trial(stamped=False)
    trial.say('agent', 0.1)
    assert trial.twist == A
    trial.say('stop', 0.2)
    assert (trial.twist, trial.stands) == (REST, True)


def test_another_who_publishes_cmd_vel_is_told():
    trial = Trial()
    assert trial.node.plain.diagnose().level == OK
    trial.node.port.publisher(TwistStamped, 'cmd_vel', COMMAND)
    found = trial.node.plain.diagnose()
    assert found.level == WARN
    assert 'cmd_vel has 1 more publishers, past the arbiter' in found.message


def test_driver_is_told_once_a_second_and_on_every_change_only():
    trial = Trial()
    trial.keep_saying('agent', 0.0, 3.5)
    moments = [moment for moment, _ in trial.said['/driver']]
    assert moments == pytest.approx([0.0, 0.0, 1.0, 2.0, 3.0])
