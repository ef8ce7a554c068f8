"""The real server on a real socket: slow readers, silent crowds, who is far away."""

from __future__ import annotations

import asyncio
import json
import socket
import ssl
import statistics
import subprocess
from contextlib import suppress

import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

from agv_motion.dashboard.server.app import application
from agv_motion.dashboard.server.serve import WebServer, listening
from agv_motion.errors import ConfigurationError


@pytest.fixture
def serve(site):
    opened = []

    def start(**options):
        server = WebServer(application(site), listening('127.0.0.1', 0), **options)
        server.start()
        opened.append(server)
        return server

    yield start
    for server in opened:
        server.close()


def upgrade(server, path='/live'):
    """Return a connection that has asked for `/live`."""
    host, port = server.listener.getsockname()
    made = socket.create_connection((host, port))
    made.sendall(
        f'GET {path} HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade'
        '\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n'
        .encode()
    )  # fmt: skip
    return made


async def look(server, frames, ages, delay=0.0):
    """Be a client that takes some frames, as far away as its delay [s]."""
    async with connect(server.url.replace('http', 'ws', 1) + '/live') as live:
        taken = 0
        async for text in live:
            told = json.loads(text)
            if told['kind'] != 'frame':
                continue
            await asyncio.sleep(delay)
            await live.send(json.dumps({'ack': told['n']}))
            ages.append(max(told['now'] - one['at'] for one in told['updates']))
            taken += 1
            if taken >= frames:
                return


def test_a_stalled_client_and_one_far_away_cost_a_good_one_nothing(serve, site, robots, run_apart):
    """What is counted is the order of things: how old, on the board's clock, what is sent."""
    server = serve()
    board = robots.board
    big = 'x' * 50_000
    frames: list[float] = []
    far: list[float] = []

    def look_at(now):
        robots.time += 0.1
        board.put('oak', 'state', robots.time, {'text': big + str(robots.time)})

    site.hub.at_each_look.append(look_at)
    with upgrade(server), upgrade(server):  # who never read

        async def both():
            slow = asyncio.create_task(look(server, 5, far, delay=0.2))
            await look(server, 40, frames)
            await slow

        run_apart(both())
        assert max(client.number for client in site.hub.clients) < 40  # they got no queue
    assert statistics.quantiles(frames, n=100)[98] <= 0.3


def test_a_silent_crowd_keeps_nobody_from_the_page(serve, run_apart):
    server = serve()
    crowd = []
    try:
        for i in range(1000):
            made = socket.create_connection(server.listener.getsockname()[:2])
            if i % 2:
                with suppress(OSError):  # sent away already
                    made.sendall(b'GET / HTTP/1.1\r\nHost: ')  # and no more
            crowd.append(made)
        ages: list[float] = []
        run_apart(asyncio.wait_for(look(server, 1, ages), 30.0))
        assert ages
    finally:
        for made in crowd:
            made.close()


def test_too_many_who_look_are_refused_and_the_others_served(serve, site):
    server = serve()
    crowd = [upgrade(server) for _ in range(60)]
    try:
        answers = [made.recv(12) for made in crowd]
        assert b'HTTP/1.1 101' in answers
        assert answers.count(b'HTTP/1.1 403') >= 20
    finally:
        for made in crowd:
            made.close()


def test_a_huge_message_ends_its_sender_alone(serve, run_apart):
    server = serve()

    async def send():
        async with connect(server.url.replace('http', 'ws', 1) + '/live') as live:
            await live.recv()
            with suppress(ConnectionClosed):
                await live.send('x' * 1_000_000)
            await live.wait_closed()
            return live.close_code

    assert run_apart(asyncio.wait_for(send(), 30.0)) in {1009, 1006}  # or reset while it sent
    run_apart(look(server, 1, []))


def test_who_floods_is_sent_away(serve, run_apart):
    server = serve()

    async def flood():
        async with connect(server.url.replace('http', 'ws', 1) + '/live') as live:
            with suppress(ConnectionClosed):
                for _ in range(500):
                    await live.send('{}')
            await live.wait_closed()
            return live.close_code

    assert run_apart(asyncio.wait_for(flood(), 30.0)) in {1008, 1006}


def test_a_port_that_is_taken_is_told_or_passed_over():
    with listening('127.0.0.1', 0) as other:
        port = other.getsockname()[1]
        with pytest.raises(ConfigurationError, match=f'port {port} of 127.0.0.1 is taken'):
            listening('127.0.0.1', port)
        with listening('127.0.0.1', port, next_free=True) as found:
            assert port < found.getsockname()[1] <= port + 20


def test_a_host_that_is_not_this_machine_is_told():
    with pytest.raises(ConfigurationError, match='cannot listen on'):
        listening('192.0.2.1', 0)


def test_with_a_certificate_the_page_is_served_by_tls(serve, tmp_path, monkeypatch, run_apart):
    certificate, key = tmp_path / 'page.pem', tmp_path / 'page.key'
    try:
        subprocess.run(  # noqa: S603 - our own
            ['openssl', 'req', '-x509', '-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:P-256',  # noqa: S607
             '-keyout', key, '-out', certificate, '-days', '2', '-nodes', '-subj', '/CN=localhost',
             '-addext', 'subjectAltName=IP:127.0.0.1'], check=True, capture_output=True,
        )  # fmt: skip
    except FileNotFoundError:
        pytest.skip('openssl is not here')
    server = serve(certificate=str(certificate), key=str(key))
    assert server.url.startswith('https://')
    context = ssl.create_default_context(cafile=str(certificate))

    async def hello():
        url = server.url.replace('https', 'wss', 1) + '/live'
        async with connect(url, ssl=context, origin=server.url) as live:
            return json.loads(await live.recv())['role']

    assert run_apart(hello()) == 'expert'


def test_a_browser_keeps_the_files_of_the_page_and_nothing_else(browser):
    first = browser.get('/static/js/operator.js')
    assert first.headers['cache-control'] == 'no-cache'
    again = browser.get('/static/js/operator.js', headers={'If-None-Match': first.headers['etag']})
    assert (again.status_code, again.content) == (304, b'')
    assert browser.get('/').headers['cache-control'] == 'no-store'
