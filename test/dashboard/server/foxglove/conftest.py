"""A graph without ROS behind the endpoint on a real socket, and clients that speak the protocol."""

from __future__ import annotations

import asyncio
import json
import struct
import threading
from contextlib import suppress
from types import SimpleNamespace as Some

import pytest

pytest.importorskip('starlette')
sync_client = pytest.importorskip('websockets.sync.client')

from websockets.exceptions import ConnectionClosed

from agv_motion.dashboard.foxglove.channels import GraphTopic
from agv_motion.dashboard.foxglove.protocol import NO_GRAPH
from agv_motion.dashboard.server.access import Access
from agv_motion.dashboard.server.app import Foxglove, application
from agv_motion.dashboard.server.foxglove.live import LiveRoom
from agv_motion.dashboard.server.serve import WebServer, listening
from agv_motion.dashboard.server.site import Site
from agv_motion.dashboard.server.store import Store
from agv_motion.dashboard.server.users import Users
from agv_motion.errors import ConfigurationError

WAIT = 20.0


class Graph:
    """A `GraphSource` whose messages a test says."""

    def __init__(self):
        self.topics = {}
        self.services = {}
        self.complaints = {}
        self.connections = NO_GRAPH
        self.simulated = False
        self.clock = None
        self.published, self.called, self.wanted = [], [], frozenset()
        self._waiting, self._changed = [], {}
        self._lock = threading.Lock()
        self.chosen = threading.Condition()

    def offer(self, name, kind='std_msgs/msg/String', definition='string data', **more):
        self.topics = self.topics | {name: GraphTopic(name, kind, definition, **more)}

    def say(self, *messages):
        """Say messages: topic, time and data of each."""
        with self._lock:
            self._waiting += messages

    def change(self, **values):
        with self._lock:
            self._changed |= values

    def wait_for(self, topics):
        """Wait until clients have chosen these topics."""
        with self.chosen:
            assert self.chosen.wait_for(lambda: self.wanted == frozenset(topics), WAIT)

    # As the server sees it

    def watch(self, topics, *, parameters, connections):
        with self.chosen:
            self.wanted, self.watched = topics, (parameters, connections)
            self.chosen.notify_all()

    def take(self):
        with self._lock:
            found, self._waiting = self._waiting, []
        return [one for one in found if one[0] in self.wanted or self.topics[one[0]].latched]

    def time(self):
        return self.clock

    def changed_parameters(self):
        with self._lock:
            found, self._changed = self._changed, {}
        return found

    def publish(self, topic, kind, data):
        self.published.append((topic, kind, data))
        return done('')

    def call(self, service, kind, data):
        self.called.append((service, kind, data))
        return done(data[::-1])

    def service_definitions(self, kind):
        if kind != 'std_srvs/srv/SetBool':
            msg = f'{kind} is not installed'
            raise ConfigurationError(msg)
        return 'bool data', 'bool success\nstring message'


def done(result):
    future = asyncio.get_running_loop().create_future()
    future.set_result(result)
    return future


class Tool:
    """A client of the endpoint."""

    def __init__(self, server, subprotocol='foxglove.sdk.v1', path='/foxglove', **options):
        url = server.url.replace('http', 'ws', 1) + path
        names = options.pop('subprotocols', [subprotocol])
        self.context = sync_client.connect(
            url, subprotocols=names, max_size=None, compression=None, open_timeout=WAIT, **options
        )
        self.socket = self.context.__enter__()
        self.kept = []
        self.info = self.wait('serverInfo')

    def ask(self, op, **told):
        self.socket.send(json.dumps({'op': op} | told))

    def wait(self, op, fits=lambda _: True):
        """Return the next message of a kind; others are kept for later."""
        for told in self.kept:
            if told['op'] == op and fits(told):
                self.kept.remove(told)
                return told
        while True:
            told = decoded(self.socket.recv(timeout=WAIT))
            if told['op'] == op and fits(told):
                return told
            self.kept.append(told)

    def refusal(self):
        return self.wait('status', lambda told: told['level'] == 2)['message']

    def channels(self, *topics):
        """Return the number of each channel, when all are advertised."""
        found = {}
        while not set(topics) <= found.keys():
            found |= {one['topic']: one for one in self.wait('advertise')['channels']}
        return [found[topic]['id'] for topic in topics]

    def subscribe(self, *topics):
        """Subscribe to topics, each by the number of its place from 0."""
        rows = [{'id': n, 'channelId': c} for n, c in enumerate(self.channels(*topics))]
        self.ask('subscribe', subscriptions=rows)

    def data(self):
        told = self.wait('message')
        return told['id'], told['data']

    def closed(self):
        """Return code and reason, when the server has closed."""
        with suppress(ConnectionClosed):
            while True:
                self.socket.recv(timeout=WAIT)
        return Some(code=self.socket.close_code, reason=self.socket.close_reason)


def decoded(message):
    if isinstance(message, str):
        return json.loads(message)
    kinds = {1: 'message', 2: 'time', 3: 'response', 4: 'asset', 5: 'playback'}
    if message[0] == 1:
        number, stamp = struct.unpack_from('<IQ', message, 1)
        return {'op': 'message', 'id': number, 'stamp': stamp, 'data': message[13:]}
    return {'op': kinds[message[0]], 'bytes': message[1:]}


@pytest.fixture
def graph():
    return Graph()


@pytest.fixture
def serve(robots, tmp_path, graph):
    """Return what serves the endpoint of the graph, and closes it."""
    opened = []

    def start(host='127.0.0.1', users=None, **options):
        store = Store(tmp_path / 'state')
        site = Site(robots, Access(host, users(store) if users else Users(store)), store)
        room = LiveRoom(site, graph)
        page = application(site, foxglove=Foxglove(room, **options))
        server = WebServer(page, listening('127.0.0.1', 0))
        server.start()
        opened.append((server, store))
        return Some(url=server.url, listener=server.listener, site=site, room=room)

    yield start
    for server, store in opened:
        server.close()
        store.close()


@pytest.fixture
def connect():
    opened = []

    def make(*args, **options):
        made = Tool(*args, **options)
        opened.append(made)
        return made

    yield make
    for one in opened:
        one.context.__exit__(None, None, None)


@pytest.fixture
def acting(serve):
    return serve(acts=True)


@pytest.fixture
def tool(acting, connect):
    return connect(acting)
