"""A real Chromium on a real server; the robots behind it are cells of a board, without ROS."""

from __future__ import annotations

import asyncio
import json
import random
import shutil
import socket
import time
from contextlib import suppress
from math import cos, pi, sin

import pytest

CHROMIUM = shutil.which('chromium-headless-shell') or shutil.which('chromium') or ''
"""The first is the same without windows: the tests take half as much computing"""
FLAGS = [
    '--no-sandbox', '--headless', '--disable-gpu', '--disable-quic', '--no-first-run',
    '--disable-background-networking', '--disable-component-update', '--disable-sync',
    # fewer processes, each of which costs a third of a second of processor to start
    '--in-process-gpu', '--renderer-process-limit=1', '--disable-site-isolation-trials',
    '--disable-features=SpareRendererForSitePerProcess',
]  # fmt: skip
PORTS = range(20000, 32000)
"""below those that the system gives away"""
TABLET = {'width': 1024, 'height': 768}
PASSWORD = 'a blue gate, 1905'  # noqa: S105 - of users that live as long as a test
ZONE = {
    'boundary': [[0, 0], [20, 0], [20, 15], [0, 15]], 'holes': [[[9, 6], [11, 6], [11, 8]]],
    'translation_only': [[[14, 1], [18, 1], [18, 4], [14, 4]]], 'margin': 0.5,
    'clearance_from': 'rim', 'home': [2, 2],
}  # fmt: skip
FRESH = 'summary', 'pose', 'twist', 'turrets', 'driver', 'clock'
"""what is said again and again"""
SUMMARY = {
    'kind': 'tree', 'colour': 'green', 'word': 'walking', 'sentence': 'walking to the sun',
    'moving': True, 'stopped': False, 'standstill': False, 'driver': 'agent', 'since': 1.0,
}  # fmt: skip


class Park:
    """Robots that say what a test lets them say, and keep what they were asked."""

    def __init__(self, *names):
        from agv_motion.dashboard.core.board import Board

        park = self

        class Speaking(Board):
            def refresh(self, now, wanted=()):
                for (robot, slot), cell in list(self.cells.items()):
                    if slot in FRESH and robot not in park.silent and now - cell.at > 0.5:
                        self.put(robot, slot, now, json.loads(cell.update)['value'], renew=True)

        self.board = Speaking()
        self.silent = set()
        """robots that go on saying nothing new"""
        self.robots = list(names)
        self.asked = []
        self.driven = []
        self.answer = ''
        self.begun = time.monotonic()

    def now(self):
        return 1000.0 + time.monotonic() - self.begun

    def say(self, robot, slot, value, age=0.0):
        """Set a cell, as if it had been told just now."""
        self.board.put(robot, slot, self.now() - age, value, renew=True)

    def tell_all(self, **changes):
        """Let every robot say something under every name."""
        for number, robot in enumerate(self.robots):
            self.tell(robot, number, **changes)
        self.say('', 'zone', ZONE)
        self.say('', 'alerts', [{'id': 'a1', 'robot': self.robots[0], 'level': 'ERROR',
                 'sentence': 'probe 2 is off', 'raised': 900.0, 'cleared': None,
                 'acknowledged': None, 'by': None}])  # fmt: skip
        self.say('', 'marks', [{'id': 'm1', 'at': 950.0, 'text': 'a dog', 'by': 'anna'}])
        self.say('', 'history', {'begin': 100.0, 'end': 1000.0})
        self.say('', 'clock', {'time': 1.7e9, 'factor': 1.0})
        self.say('', 'reservations', [{'robot': robot, 'kind': 'held', 'width': 2.4,
                 'points': [[3, 3], [5, 4]]} for robot in self.robots])  # fmt: skip

    def sum_up(self, robot, **changes):
        self.say(robot, 'summary', SUMMARY | changes)

    def tell(self, robot, number=0, **changes):
        say = self.say
        self.sum_up(robot, **changes)
        turrets = [[0.8 * cos(i * 2 * pi / 3), 0.8 * sin(i * 2 * pi / 3)] for i in range(3)]
        say(robot, 'platform', {'kind': 'tree', 'radius': 1.18, 'turrets': turrets,
            'wheel_radius': 0.1})  # fmt: skip
        say(robot, 'pose', {'x': 4 + 4 * number, 'y': 4, 'heading': 1.0,
            'covariance': [0.02, 0.0, 0.02, 0.01]})  # fmt: skip
        state = {'angles': [0.1, 0.2, 0.3], 'speeds': [0.01, 0.02, 0.015]}
        say(robot, 'turrets', state | {'commanded': state})
        say(robot, 'twist', {'vx': 0.0155, 'vy': 0.0, 'wz': 0.01, 'icr': [0.0, 1.55]})
        say(robot, 'driver', {'driver': 'agent', 'sentence': 'agent drives', 'stop': False,
            'lock': '', 'sources': []})  # fmt: skip
        say(robot, 'goal', {'x': 15, 'y': 12, 'heading': 0.0, 'reason': 'never visited'})
        say(robot, 'path', {'points': [[4, 4], [15, 12]]})
        say(robot, 'trail', {'points': [[3, 3], [4, 4]]})
        say(robot, 'sun', {'illuminance': 88000.0})
        say(robot, 'why', {'links': [{'name': 'wheels', 'level': 'WARN',
            'sentence': 'wheels stand', 'age': 0.1, 'since': '14:02', 'remedy': 'look at it',
            'limit': '1 m/min'}]})  # fmt: skip
        say(robot, 'probes', {'probes': [{'name': 'probe_1', 'temperature_difference': 17.8,
            'quality': 'good', 'text': 'good', 'signal': 0.8}]})  # fmt: skip
        say(robot, 'sap_flow', {'s': [0.8, 0.4, None], 'valid': True})
        say(robot, 'day', {'times': [0.0, 3600.0], 's1': [0.1, 0.9], 's2': [0.2, None],
            's3': [0.3, 0.4], 'drunk': 3.2})  # fmt: skip
        litres = {'value': 12.3, 'low': 3.84, 'high': 39.4}
        say(robot, 'drank', {'hours': 3.2, 'litres': None if number else litres})
        say(robot, 'health', {'nodes': [{'name': 'arbiter', 'level': 'OK', 'message': 'well',
            'age': 0.2, 'values': {'limit': '0.5'}}],
            'inputs': [{'topic': 'pose', 'age': 0.1, 'limit': 2.0},
                       {'topic': 'fix', 'age': None, 'limit': 5.0}]})  # fmt: skip
        row = {'name': 'max_wheel_speed', 'value': 0.0333, 'default': 0.03, 'unit': 'm/s',
               'low': 0.0, 'high': 10.0, 'text': 'largest speed', 'choices': [],
               'dynamic': True}  # fmt: skip
        say(robot, 'parameters', {'nodes': [{'node': 'arbiter', 'rows': [row]}]})

    def act(self, robot, action, arguments):
        self.asked.append((robot, action, arguments))
        future = asyncio.get_running_loop().create_future()
        if isinstance(self.answer, Exception):
            future.set_exception(self.answer)
        else:
            future.set_result(self.answer)
        return future

    def drive(self, robot, twist, age):
        self.driven.append((robot, twist, age))


@pytest.fixture(scope='session')
def chromium():
    """Return a browser for all tests of this run."""
    playwright = pytest.importorskip('playwright.sync_api', reason='playwright is not installed')
    if not CHROMIUM:
        pytest.skip('chromium is not installed')
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield browser
        browser.close()


@pytest.fixture(scope='session')
def tab(chromium):
    """Return the tab in which pages open: it costs half as much as a new one for each."""
    context = chromium.new_context()
    context.set_default_timeout(15000)
    return context.new_page()


@pytest.fixture
def open_page(chromium, tab):
    """Return what opens a page, a second one in a browser of its own.

    An error in a page fails the test.
    """
    pages, errors = [], []

    def note(error):
        errors.append(str(error))

    def make(url, size=TABLET, *, color_scheme='light', reduced_motion='reduce'):
        page = tab if not pages else chromium.new_context().new_page()
        pages.append(page)
        page.set_viewport_size(size)
        page.emulate_media(color_scheme=color_scheme, reduced_motion=reduced_motion)
        page.on('pageerror', note)
        page.goto(url)
        return page

    yield make
    for page in pages[1:]:
        page.context.close()
    for page in pages[:1]:
        page.goto('about:blank')
        page.context.clear_cookies()
        page.remove_listener('pageerror', note)
    assert errors == []


@pytest.fixture(scope='session')
def usual_port():
    """Return a port for one server after the other: what comes from it the browser keeps."""
    for port in random.sample(PORTS, len(PORTS)):
        with suppress(OSError), socket.create_server(('127.0.0.1', port)):
            return port
    return 0


@pytest.fixture
def serve(tmp_path, usual_port):
    """Return what serves a page over robots, for users or for whoever is at this machine."""
    pytest.importorskip('starlette')
    from argon2 import PasswordHasher

    from agv_motion.dashboard.server.access import Access
    from agv_motion.dashboard.server.app import application
    from agv_motion.dashboard.server.serve import WebServer, listening
    from agv_motion.dashboard.server.site import Site
    from agv_motion.dashboard.server.store import Store
    from agv_motion.dashboard.server.users import Users
    from agv_motion.errors import ConfigurationError

    opened = []

    def listen(port):
        try:
            return listening('127.0.0.1', port or usual_port)
        except ConfigurationError:
            if port:
                raise
            return listening('127.0.0.1', 0)

    def make(park, roles=(), port=0):
        store = Store(tmp_path / 'state')
        quick = PasswordHasher(time_cost=1, memory_cost=8, parallelism=1)
        users = Users(store, hasher=quick)
        for role in roles:
            users.add(f'{role}s', PASSWORD, role)
        site = Site(park, Access('127.0.0.1', users), store)
        server = WebServer(application(site), listen(port))
        server.start()
        opened.append((server, store))
        return server

    yield make
    for server, store in opened:
        server.close()
        store.close()


@pytest.fixture
def make_park():
    """Return what makes robots by their names."""
    return Park


@pytest.fixture
def park():
    """Return three robots that have told everything."""
    found = Park('oak', 'ash', 'elm')
    found.tell_all()
    return found


@pytest.fixture
def log_in():
    """Return what logs a page in as a user of a role."""

    def make(page, role):
        page.fill('#user', f'{role}s')
        page.fill('#password', PASSWORD)
        page.press('#password', 'Enter')
        page.wait_for_selector('#bar-name:not(:empty)')

    return make
