"""A graph without ROS behind the endpoint on a real socket, and clients that speak the protocol."""

from __future__ import annotations

import asyncio
import threading
from types import SimpleNamespace as Some

import pytest

pytest.importorskip('starlette')
pytest.importorskip('websockets')

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

    def watch(self, topics, *, clients, parameters, connections):
        with self.chosen:
            self.wanted, self.watched = topics, (parameters, connections)
            self.clients = clients
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

    def prepare(self, topic, kind):
        return done('')

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
def acting(serve):
    return serve(acts=True)


@pytest.fixture
def tool(acting, connect):
    return connect(acting)
