"""`agv foxglove`: a bag without ROS, refusals in words, and tokens for tools from elsewhere."""

from __future__ import annotations

import signal
import struct
from types import SimpleNamespace as Some

import pytest

pytest.importorskip('starlette')
pytest.importorskip('websockets')

from typer.testing import CliRunner

from agv_motion.bag import BagWriter
from agv_motion.cli.dashboard.user import app
from agv_motion.dashboard.server.roles import Role
from agv_motion.dashboard.server.store import Store
from agv_motion.dashboard.server.users import Users
from agv_motion.errors import AgvMotionError


@pytest.fixture
def walk(tmp_path):
    with BagWriter(tmp_path / 'walk') as bag:
        topic = bag.add_topic('/count', 'std_msgs/msg/UInt32', 'uint32 data')
        for number in range(1, 4):
            bag.write(topic, number * 1_000_000, b'\0\1\0\0' + struct.pack('<I', number))
    return tmp_path / 'walk'


def test_a_bag_is_served_without_ros(alone, walk, tmp_path, connect):
    words = 'foxglove', walk, '--port', 0, '--state-folder', tmp_path / 'state', '--rate', 0.01
    process = alone.start(*words)
    address = process.stdout.readline().split(' is at ')[1].split(';')[0]
    assert address.startswith('ws://127.0.0.1:')
    tool = connect(Some(url=address.replace('ws', 'http', 1)), path='/')
    tool.subscribe('/count')
    assert tool.data()[0] == 0
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60.0)
    assert process.returncode == 0


def test_a_rate_that_cannot_be_played_is_told(alone, walk, tmp_path):
    given = '--rate', '1000', '--port', 0, '--state-folder', tmp_path
    status, _, errors = alone('foxglove', walk, *given)
    assert status == 1
    assert 'rate = 1000' in errors


def test_a_token_is_that_of_its_user_for_its_hours_and_no_longer(tmp_path):
    """Also not when the clock has gone on, nor with another role written into it."""
    given = '--state-folder', str(tmp_path)
    run = CliRunner().invoke
    run(app, ['add', 'anna', '--password-stdin', *given], input='a blue gate, 1905\n')
    token = run(app, ['token', 'anna', '--hours', '2', *given]).output.strip()
    assert token.startswith('?token=anna!viewer!')
    token = token.removeprefix('?token=')
    store = Store(tmp_path)
    now = [1e12]
    try:
        users = Users(store)
        assert users.bearer(token).role is Role.VIEWER
        assert users.bearer(token.replace('viewer', 'expert')) is None
        assert users.bearer(token.replace('anna', 'bert')) is None
        assert Users(store, clock=lambda: now[0]).bearer(token) is None
        users.remove('anna')
        assert users.bearer(token) is None
    finally:
        store.close()
    for words in (['token', 'nobody'], ['token', 'anna', '--hours', 'nan'], ['token', 'anna']):
        assert isinstance(run(app, [*words, *given]).exception, AgvMotionError)
