"""Node `sequence` over a real graph: from a file to the end, and every way to stop."""

from __future__ import annotations

from math import hypot

import pytest

rclpy = pytest.importorskip('rclpy')

from diagnostic_msgs.msg import DiagnosticStatus
from nav_msgs.msg import Path
from rclpy.parameter import Parameter
from std_msgs.msg import Float64, String
from std_srvs.srv import SetBool, Trigger

from agv_motion.nodes.sequence import SequenceNode
from agv_motion.ros.qos import LATCHED, SENSOR
from agv_motion.ros.run import StartError

PACE = 'defaults: {timeout: 20, go_to: {speed: 1.0, acceleration: 4.0}}\n'
SHORT = (
    PACE
    + """
name: short
actions:
  - go_to: {x: 0.3, y: 0.1, heading: 30}
  - rotate: {by: 45, speed: 180, acceleration: 720}
  - wait: 0.1
  - arc: {angle: 60, diameter: 0.2, speed: 1.0, acceleration: 4.0}
  - follow_route: {waypoints: [[0.3, 0.3], [0.0, 0.6]]}
"""
)
LONG = PACE + 'actions:\n  - go_to: {x: 50.0, y: 0.0, heading: 0}\n  - wait: 1\n'


class Mission:
    """A robot, the node, and a file."""

    def __init__(self, tester, robot, file, *, find=True, **parameters):
        self.tester = tester
        self.states = tester.listen(String, 'sequence/state', LATCHED)
        self.robot = robot
        self.node = tester.start(SequenceNode, **({'file': str(file)} | parameters))
        if find:
            self.robot.find()
            tester.graph.spin_until(lambda: not self.node.plain.lost)

    def says(self, words, timeout=60.0):
        return self.tester.wait(self.states, lambda m: words in m.data, timeout)

    def ask(self, service, data=None):
        kind = Trigger if data is None else SetBool
        request = kind.Request() if data is None else kind.Request(data=data)
        return self.tester.ask(kind, f'sequence/{service}', request)

    def runs(self):
        answer = self.ask('start')
        assert answer.success, answer.message
        self.robot.moves()


@pytest.fixture
def start(tester, real_time_robot, tmp_path):
    def started(text, **parameters):
        file = tmp_path / 'mission.yaml' if text else ''
        if text:
            file.write_text(text)
        return Mission(tester, real_time_robot(), file, **parameters)

    return started


def test_all_five_actions_are_performed_and_progress_is_told(start, tester):
    progress = tester.listen(Float64, 'sequence/progress', SENSOR)
    status = tester.listen(DiagnosticStatus, 'sequence/status', LATCHED)
    paths = tester.listen(Path, 'sequence/path', LATCHED)
    mission = start(SHORT)
    answer = mission.ask('start')
    assert 'short: 5 actions, about' in answer.message
    for words in ('1 of 5: go_to x 0.3', '2 of 5: rotate', '3 of 5: wait', '4 of 5: arc', '5 of 5'):
        mission.says(words)
    mission.says('done')
    mission.robot.stands()
    assert hypot(mission.robot.pose.x, mission.robot.pose.y - 0.6) < 0.05
    assert [message.data for message in progress] == sorted(message.data for message in progress)
    tester.wait(progress, lambda m: m.data == 1.0)
    told = {
        pair.key: pair.value for pair in tester.wait(status, lambda m: 'done' in m.message).values
    }
    assert (told['sequence'], told['number'], told['of']) == ('short', '5', '5')
    assert len(tester.wait(paths).poses) > 20


def test_autorun_starts_when_the_pose_is_known(start):
    mission = start(SHORT, find=False, autorun=True)
    assert 'no odom yet' in mission.ask('start').message
    mission.robot.find()
    mission.says('2 of 5')


def test_pause_stops_and_goes_on(start):
    mission = start(LONG)
    assert 'nothing is running' in mission.ask('pause', data=True).message
    mission.runs()
    assert mission.ask('pause', data=True).success
    mission.says('paused, 1 of 2')
    mission.robot.stands()
    assert mission.ask('pause', data=False).success
    mission.robot.moves()
    assert 'running already' in mission.ask('start').message


def test_abort_brakes_and_ends_it(start):
    mission = start(LONG)
    mission.runs()
    assert mission.ask('abort').success
    mission.says('aborted')
    mission.robot.stands()
    assert 'nothing is running' in mission.ask('abort').message
    mission.runs()


def test_silence_of_odom_is_an_explicit_stop(start):
    mission = start(LONG, report_after=0.1, stop_after=0.3)
    mission.runs()
    mission.robot.silent = True
    mission.says('stopped: no odom for 0.3 s (1 of 2')
    mission.robot.stands()
    mission.robot.silent = False
    mission.robot.moves()


def test_a_failure_says_where_it_stands_in_the_file(start):
    mission = start(LONG.replace('timeout: 20', 'timeout: 1'))
    mission.runs()
    mission.robot.stuck = True
    said = mission.says('failed: ').data
    assert 'mission.yaml, line 3, column 5: go_to x 50' in said
    assert 'not done within 1 s' in said
    mission.robot.stands()


def test_the_last_word_is_zero(start, tester):
    mission = start(LONG)
    mission.runs()
    mission.robot.commands.clear()
    mission.node.trigger_shutdown()
    tester.wait(mission.robot.commands, lambda command: not any(command))
    assert not any(mission.robot.commands[-1])


def test_a_bad_file_is_refused_at_the_start_and_at_run_time(start, tmp_path, capfd):
    with pytest.raises(StartError):
        start('actions: [{dance: 1}]', find=False)
    assert 'choose one of go_to, rotate' in capfd.readouterr().err
    mission = start(SHORT)
    bad = tmp_path / 'bad.yaml'
    bad.write_text('actions: []')
    (refused,) = mission.node.set_parameters([Parameter('file', value=str(bad))])
    assert 'line 1, column 10: actions: the list is empty' in refused.reason
    bad.write_text('actions:\n  - secret: 1')
    (refused,) = mission.node.set_parameters([Parameter('file', value=str(bad))])
    assert 'line 2, column 5: unknown action; choose one of go_to' in refused.reason
    assert 'secret' not in refused.reason


def test_what_cannot_be_planned_from_here_is_refused(start):
    mission = start('actions: [{go_to: {x: 1, y: 0, heading: 180, curve: 1}}]')
    answer = mission.ask('start')
    assert not answer.success
    assert 'cusp' in answer.message


def test_without_a_file_there_is_nothing_to_start(start, tester, capfd):
    mission = start('')
    assert 'give the parameter file' in mission.ask('start').message
    with pytest.raises(StartError):
        tester.start(SequenceNode, autorun=True)
    assert 'autorun without a file' in capfd.readouterr().err
