"""Every topic of a tree, read through the endpoint by clients that share no code with it.

The bag of a whole simulated tree is served; `rosbags` decodes what comes by the definitions that
were told with it, and Foxglove's own npm packages do, where Node.js is installed. What they find is
what the bag has, value by value.
"""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path
from types import SimpleNamespace as Some

import numpy as np
import pytest

pytest.importorskip('rclpy')  # of which the simulated tree consists

from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from agv_motion.bag import BagReader
from agv_motion.dashboard.server.access import Access
from agv_motion.dashboard.server.app import Foxglove, application
from agv_motion.dashboard.server.bag_fleet import BagFleet
from agv_motion.dashboard.server.foxglove.recorded import RecordedRoom
from agv_motion.dashboard.server.serve import WebServer, listening
from agv_motion.dashboard.server.site import Site

NODE = shutil.which('node')
SOURCE = Path(__file__).parent / 'independent_client'
CACHE = Path(__file__).parents[4] / 'build' / 'independent_client'
MADE = '/tf', '/tf_static'


@pytest.fixture(scope='module')
def tree(recorded):
    return recorded / 'a'


@pytest.fixture(scope='module')
def server(tree):
    site = Site(BagFleet(tree), Access('127.0.0.1', None), recorded=True)
    page = application(site, foxglove=Foxglove(RecordedRoom(tree, 100.0), alone=True))
    made = WebServer(page, listening('127.0.0.1', 0))
    made.start()
    yield Some(url=made.url)
    made.close()


@pytest.fixture(scope='module')
def node():
    """Return the path of the client in JavaScript, or skip soon where npm installs nothing."""
    if NODE is None:
        pytest.skip('Node.js is not installed')
    CACHE.mkdir(parents=True, exist_ok=True)
    wanted = (SOURCE / 'package.json').read_text()
    installed = CACHE / 'installed.json'
    for file in SOURCE.iterdir():
        shutil.copy(file, CACHE)
    if not installed.exists() or installed.read_text() != wanted:
        npm = ['npm', 'install', '--no-audit', '--no-fund', '--loglevel=error',
               '--fetch-retries=0', '--fetch-timeout=30000']  # fmt: skip
        try:
            done = subprocess.run(npm, cwd=CACHE, capture_output=True, timeout=120, check=False)  # noqa: S603
        except subprocess.TimeoutExpired:
            pytest.skip('npm installs nothing here within two minutes')
        if done.returncode:
            pytest.skip(f'npm installs nothing here: {done.stderr[-300:]!r}')
        installed.write_text(wanted)
    return CACHE / 'read.cjs'


def decoder(channel):
    store, kind = get_typestore(Stores.EMPTY), channel['schemaName']
    store.register(get_types_from_msg(channel['schema'], kind))
    return lambda data: store.deserialize_cdr(data, kind)


def plain(value):
    """Return a message of rosbags as JSON would have it, field by field."""
    if hasattr(value, '__dataclass_fields__'):
        return {
            n: plain(getattr(value, n)) for n in value.__dataclass_fields__ if n != '__msgtype__'
        }
    if isinstance(value, (list, tuple, np.ndarray)):
        return [plain(one) for one in value]
    return value.item() if isinstance(value, np.generic) else value


def test_rosbags_reads_every_topic_as_the_bag_has_it(server, connect, tree):
    tool = connect(server)
    channels = {one['topic']: one for one in tool.wait('advertise')['channels']}
    with BagReader(tree) as bag:
        said = {topic: set() for topic in bag.topics}
        for message in bag.messages():
            said[message.connection.topic].add(message.data)
    assert channels.keys() >= said.keys()
    rows = [{'id': one['id'], 'channelId': one['id']} for one in channels.values()]
    tool.ask('subscribe', subscriptions=rows)
    names = {one['id']: topic for topic, one in channels.items()}
    decode = {topic: decoder(one) for topic, one in channels.items()}
    left = set(said)
    while left:
        number, data = tool.data()
        topic = names[number]
        assert topic in MADE or data in said[topic]
        assert decode[topic](data) is not None
        left.discard(topic)


@pytest.mark.parametrize('subprotocol', ['foxglove.sdk.v1', 'foxglove.websocket.v1'])
def test_foxglove_reads_every_topic_as_the_bag_has_it(server, tree, node, subprotocol):
    with BagReader(tree) as bag:
        topics = dict(bag.topics)
        said = {topic: [] for topic in topics}
        for message in bag.messages():
            said[message.connection.topic].append(message.data)
    url = server.url.replace('http', 'ws', 1)
    command = [NODE, str(node), url, subprotocol, ','.join(topics), '40']
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)  # noqa: S603
    found = json.loads(done.stdout)
    later = 'Error: Unrecognized server opcode in binary message: 5'
    assert set(found['errors']) <= {later}  # the state of a playback, which it does not know yet
    assert set(found['topics']) >= topics.keys()
    for topic, connection in topics.items():
        decode = decoder({'schemaName': connection.type, 'schema': connection.definition})
        expected = {json.dumps(normal(plain(decode(data)))) for data in set(said[topic])}
        assert found['messages'][topic]
        for message in found['messages'][topic]:
            assert json.dumps(normal(message['value'])) in expected, topic


def normal(value):
    """Return a value as both libraries tell it: a time has two names for its parts."""
    if isinstance(value, dict):
        named = {'nanosec' if key == 'nsec' else key: one for key, one in value.items()}
        return {key: normal(named[key]) for key in sorted(named)}
    if isinstance(value, list):
        return [normal(one) for one in value]
    if isinstance(value, float):
        return None if value != value else round(value, 12)  # noqa: PLR0124 - NaN
    return float(value) if isinstance(value, int) and not isinstance(value, bool) else value
