"""Brokers of MQTT: a small one of our own, which does just what a test asks, and mosquitto."""

from __future__ import annotations

import shutil
import socket
import struct
import subprocess
import threading
from contextlib import suppress
from itertools import count
from types import SimpleNamespace

import pytest

CONNECT, CONNACK, PUBLISH, PUBACK, SUBSCRIBE, SUBACK, PING, PONG, DISCONNECT = (
    1, 2, 3, 4, 8, 9, 12, 13, 14,
)  # fmt: skip
IDS = count(1)


def packet(kind, flags, body):
    """Return a packet of MQTT 3.1.1: kind and flags, length in groups of seven bits, body."""
    length, digits = len(body), []
    while True:
        length, digit = divmod(length, 128)
        digits.append(digit | (128 if length else 0))
        if not length:
            return bytes([kind << 4 | flags, *digits]) + body


def published(topic, payload, *, qos=1, retain=False, dup=False):
    """Return a PUBLISH packet."""
    name = topic.encode()
    number = struct.pack('>H', next(IDS) % 65535 + 1) if qos else b''
    head = struct.pack('>H', len(name)) + name + number
    return packet(PUBLISH, dup << 3 | qos << 1 | retain, head + payload)


def read_packet(stream):
    """Return kind, flags and body of the next packet; None at the end."""
    first = stream.read(1)
    if not first:
        return None
    length = shift = 0
    while True:
        (digit,) = stream.read(1)
        length |= (digit & 127) << shift
        if digit < 128:
            return first[0] >> 4, first[0] & 15, stream.read(length)
        shift += 7


def words(body, at, number):
    """Return length-prefixed words of a body."""
    found = []
    for _ in range(number):
        (length,) = struct.unpack_from('>H', body, at)
        found.append(body[at + 2 : at + 2 + length])
        at += 2 + length
    return found


class SmallBroker:
    """Takes clients, notes who they say they are, and sends all of them what a test publishes."""

    def __init__(self, port=0, tls=None):
        self.refuse = self.refuse_topics = 0
        self.kept, self.clients, self.heard = [], [], []
        self.tls = tls
        self.listener = socket.create_server(('127.0.0.1', port))
        self.port = self.listener.getsockname()[1]
        self.threads = [threading.Thread(target=self._accept, daemon=True)]
        self.threads[0].start()

    def publish(self, topic, payload, **flags):
        if flags.get('retain'):
            self.kept = [published(topic, payload, **flags)]
        for client in self.clients:
            client.sendall(published(topic, payload, **flags | {'retain': False}))

    def drop(self):
        """Leave all clients, as a broker does that is started again."""
        for client in self.clients:
            with suppress(OSError):
                client.shutdown(socket.SHUT_RDWR)

    def close(self):
        with suppress(OSError):
            self.listener.shutdown(socket.SHUT_RDWR)
        self.listener.close()
        self.drop()
        for thread in self.threads:
            thread.join(10.0)

    def _accept(self):
        with suppress(OSError):
            while True:
                client, _ = self.listener.accept()
                self.threads.append(threading.Thread(target=self._serve, args=(client,)))
                self.threads[-1].start()

    def _serve(self, client):
        with suppress(OSError, ValueError), client:
            if self.tls:
                client = self.tls.wrap_socket(client, server_side=True)
            with client, client.makefile('rb') as stream:
                while (found := read_packet(stream)) and found[0] != DISCONNECT:
                    self._answer(client, *found)
        if client in self.clients:
            self.clients.remove(client)

    def _answer(self, client, kind, flags, body):
        if kind == CONNECT:
            flags = body[7]
            number = 1 + (flags >> 7) + (flags >> 6 & 1)
            self.heard.append(words(body, 10, number))
            client.sendall(packet(CONNACK, 0, bytes([0, self.refuse])))
            if self.refuse:
                raise ValueError
        elif kind == SUBSCRIBE:
            at, answer = 2, b''
            while at < len(body):
                at += 3 + len(*words(body, at, 1))  # length, topic, quality of service
                answer += bytes([128 if self.refuse_topics else 1])
            client.sendall(packet(SUBACK, 0, body[:2] + answer))
            for each in self.kept:  # to who subscribes now; to the others it was sent as new
                client.sendall(each)
            self.clients.append(client)
        elif kind == PING:
            client.sendall(packet(PONG, 0, b''))


@pytest.fixture
def small_broker():
    """Return the small broker, and what makes another."""
    made = []

    def make(**given):
        made.append(SmallBroker(**given))
        return made[-1]

    yield make
    for each in made:
        each.close()


@pytest.fixture(scope='module')
def mosquitto():
    """Return mosquitto, where it is installed, with what publishes at it."""
    program = shutil.which('mosquitto') or shutil.which('mosquitto', path='/usr/sbin')
    if program is None:
        pytest.skip('mosquitto is not installed')
    client = pytest.importorskip('paho.mqtt.client')
    with socket.create_server(('127.0.0.1', 0)) as free:
        port = free.getsockname()[1]
    command = [program, '-p', f'{port}']
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL)  # noqa: S603 - as it is found
    ready = threading.Event()
    publisher = client.Client(client.CallbackAPIVersion.VERSION2)
    publisher.on_connect = lambda *_: ready.set()
    publisher.reconnect_delay_set(1, 1)
    publisher.connect_async('127.0.0.1', port)
    publisher.loop_start()
    assert ready.wait(60.0)
    yield SimpleNamespace(
        port=port,
        publish=lambda topic, payload, **flags: publisher.publish(
            topic, payload, qos=1, **flags
        ).wait_for_publish(60.0),
    )
    publisher.disconnect()
    publisher.loop_stop()
    process.terminate()
    process.wait(30.0)
