"""`agv dashboard`: users from the command line, a bag without ROS, no open door by mistake."""

from __future__ import annotations

import signal
import urllib.request

import pytest

pytest.importorskip('starlette')

from typer.testing import CliRunner

from agv_motion.bag import BagWriter
from agv_motion.cli.dashboard.user import app
from agv_motion.errors import AgvMotionError


@pytest.fixture
def user(tmp_path):
    def run(*words, password='a blue gate, 1905'):  # noqa: S107 - of nobody
        given = [*words, '--state-folder', str(tmp_path)]
        if words[0] in {'add', 'password'}:
            given.append('--password-stdin')
        return CliRunner().invoke(app, given, input=f'{password}\n')

    return run


def test_users_come_change_and_go(user):
    assert 'anna may log in as operator' in user('add', 'anna').output
    assert 'bert may log in as expert' in user('add', 'bert', '--role', 'expert').output
    assert user('list').output.splitlines() == ['anna operator', 'bert expert']
    assert user('role', 'anna', 'viewer').exit_code == 0
    assert user('password', 'anna', password='another gate, 1906').exit_code == 0  # noqa: S106
    assert user('remove', 'bert').exit_code == 0
    assert user('list').output.splitlines() == ['anna viewer']


@pytest.mark.parametrize(
    ('words', 'password', 'why'),
    [
        (('add', 'anna', '--role', 'king'), 'a blue gate, 1905', 'choose one of'),
        (('add', '<b>'), 'a blue gate, 1905', 'letters, digits'),
        (('add', 'anna'), 'short', 'use 10 to 200'),
        (('add', 'anna'), 'anna anna anna', 'soon guessed'),
        (('remove', 'nobody'), '', "no user 'nobody'"),
    ],
)
def test_what_cannot_be_is_told(user, words, password, why):
    result = user(*words, password=password)
    assert isinstance(result.exception, AgvMotionError)
    assert why in str(result.exception)
    assert password == '' or password not in str(result.exception)


def test_beyond_this_machine_it_does_not_start_without_a_user(alone, tmp_path):
    pytest.importorskip('rclpy')
    given = '--host', '0.0.0.0', '--port', 0, '--state-folder', tmp_path  # noqa: S104 - refused
    status, _, errors = alone('dashboard', *given)
    assert status == 1
    assert 'agv dashboard user add NAME' in errors


def test_a_bag_is_served_without_ros(alone, tmp_path):
    with BagWriter(tmp_path / 'walk') as bag:
        bag.add_topic('/oak/odom', 'nav_msgs/msg/Odometry', 'string data')
    process = alone.start(
        'dashboard', tmp_path / 'walk', '--port', 0, '--state-folder', tmp_path / 'state'
    )
    url = process.stdout.readline().split(' is at ')[1].split(';')[0]
    with urllib.request.urlopen(f'{url}/health') as answer:  # noqa: S310 - ours
        assert b'"robots":1' in answer.read()
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60.0)
    assert process.returncode == 0


def test_a_bag_that_is_not_there_is_told(alone, tmp_path):
    status, _, errors = alone('dashboard', tmp_path / 'no')
    assert status == 1
    assert str(tmp_path / 'no') in errors.replace('\n', '')
