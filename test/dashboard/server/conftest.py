"""A page over robots without ROS, as browsers see it."""

from __future__ import annotations

import warnings

import pytest

pytest.importorskip('starlette')

with warnings.catch_warnings():  # of the client that it will want one day
    warnings.simplefilter('ignore')
    from starlette.testclient import TestClient

from argon2 import PasswordHasher

from agv_motion.dashboard.server.access import Access
from agv_motion.dashboard.server.app import application
from agv_motion.dashboard.server.site import Site
from agv_motion.dashboard.server.store import Store
from agv_motion.dashboard.server.users import Users

PLACE = 'http://127.0.0.1:8080'
QUICK = PasswordHasher(time_cost=1, memory_cost=8, parallelism=1)
PASSWORD = 'a blue gate, 1905'  # noqa: S105 - of nobody


class Browser(TestClient):
    """A browser of this machine, or of another one, on our own page."""

    __test__ = False

    def __init__(self, site, client='127.0.0.1', place=PLACE, **options):
        super().__init__(application(site, **options), base_url=place, client=(client, 50000))
        self.place = place
        self.headers['origin'] = place
        self.count = 0

    def look(self, query=''):
        """Return a context of `/live`."""
        return self.socket(f'/live{query}')

    def socket(self, path, **headers):
        place = self.place.replace('http', 'ws', 1)
        return self.websocket_connect(place + path, headers={'origin': self.place} | headers)

    def hello(self):
        with self.look() as live:
            return live.receive_json()

    def act(self, path, told=None, **headers):
        """Act as the page does: with the token and a new key."""
        self.count += 1
        given = {'X-CSRF-Token': self.hello()['csrf'], 'Idempotency-Key': f'key-{self.count:08}'}
        return self.post(path, json=told or {}, headers=given | headers)


@pytest.fixture
def site(robots, tmp_path):
    """Return a page on this machine alone."""
    store = Store(tmp_path / 'state')
    yield Site(robots, Access('127.0.0.1', Users(store, hasher=QUICK)), store)
    store.close()


@pytest.fixture
def browser(site):
    """Return a browser on this machine."""
    with Browser(site) as found:
        yield found


@pytest.fixture
def open_browser(site):
    """Return the class of browsers, and the page on this machine."""
    return lambda **options: Browser(site, **options)


@pytest.fixture
def guarded(robots, tmp_path):
    """Return a page that other machines reach, with a user of each role."""
    store = Store(tmp_path / 'state')
    users = Users(store, hasher=QUICK)
    for role in ('viewer', 'operator', 'expert'):
        users.add(f'{role}s', PASSWORD, role)
    yield Site(robots, Access('192.168.1.4', users), store)
    store.close()


@pytest.fixture
def visit(guarded):
    """Return what makes a browser from elsewhere, logged in as a user."""
    opened = []

    def make(user='', client='10.0.0.7'):
        found = Browser(guarded, client=client)
        found.__enter__()
        opened.append(found)
        if user:
            answer = found.post('/login', json={'user': user, 'password': PASSWORD})
            assert answer.status_code == 200, answer.text
        return found

    yield make
    for found in opened:
        found.__exit__(None, None, None)
