"""What `/foxglove` costs beside foxglove-sdk's server, in one run, also with a stalled client.

    launch_scripts/benchmarks/benchmark_foxglove.py           # 20,000 messages/s of 1 kB, 20 topics
    launch_scripts/benchmarks/benchmark_foxglove.py 5000 200  # messages/s, topics

Both servers are fed alike in their own process, by a talker in a thread of its own that keeps to a
clock; a client in a process of its own subscribes to everything. Told are messages per second that
came, the time from being said to being read (p50, p99), and the processor time of the server per
second, the talker's own (measured first, without a server) taken off. `graph` is the whole way from
a ROS graph, the middleware included: only ours is tried there. Needs the extras dashboard and
benchmark. Processor times depend on what else the machine does: compare within one run.
"""

from __future__ import annotations

import json
import os
import socket
import statistics
import struct
import subprocess
import sys
import time
from pathlib import Path

SIZE = 1000
"""[bytes] of a message"""
SECONDS = 6.0
"""[s] of each measurement"""
LOOK = 0.002
"""[s] between two bursts of the talker"""
SUBPROTOCOL = 'foxglove.sdk.v1'


HEAD = b'\0\1\0\0' + struct.pack('<I', SIZE - 8)
"""of a std_msgs/msg/String in CDR"""


def talk(rate, topics, send):
    """Say messages for ever: each bears the time at which it was said."""
    begun, said = time.monotonic(), 0
    body = bytes(SIZE - 17) + b'\0'
    while True:
        due = int((time.monotonic() - begun) * rate)
        for number in range(said, due):
            send(number % topics, HEAD + struct.pack('<q', time.monotonic_ns()) + body)
        said = due
        time.sleep(LOOK)


class Said:
    """A `GraphSource` that a thread feeds."""

    def __init__(self, topics):
        """Offer topics."""
        from collections import deque

        from agv_motion.dashboard.foxglove.channels import GraphTopic
        from agv_motion.dashboard.foxglove.protocol import NO_GRAPH

        self.names = [f'/t{n}' for n in range(topics)]
        self.topics = {n: GraphTopic(n, 'std_msgs/msg/String', 'string data') for n in self.names}
        self.services, self.complaints, self.connections = {}, {}, NO_GRAPH
        self.simulated, self._wanted = False, frozenset()
        self._waiting = deque()

    def send(self, number, data):
        """Say a message."""
        self._waiting.append((self.names[number], 0, data))

    def watch(self, topics, **_):
        """Take what is wanted."""
        self._wanted = topics

    def take(self):
        """Yield what was said."""
        for _ in range(len(self._waiting)):
            one = self._waiting.popleft()
            if one[0] in self._wanted:
                yield one

    def time(self):
        """Return that time is real."""
        return

    def changed_parameters(self):
        """Return that none have changed."""
        return {}


def ours(port, rate, topics):
    """Be our server."""
    from agv_motion.dashboard.core.board import Board
    from agv_motion.dashboard.server.access import Access
    from agv_motion.dashboard.server.app import Foxglove, application
    from agv_motion.dashboard.server.foxglove.live import LiveRoom
    from agv_motion.dashboard.server.serve import WebServer, listening
    from agv_motion.dashboard.server.site import Site

    class Nobody:
        board, robots = Board(), ()
        now = time.time

    source = Said(topics)
    site = Site(Nobody(), Access('127.0.0.1', None))
    page = application(site, foxglove=Foxglove(LiveRoom(site, source), alone=True))
    WebServer(page, listening('127.0.0.1', port)).start()
    talk(rate, topics, source.send)


def sdk(port, rate, topics):
    """Be foxglove-sdk's server."""
    from foxglove import Channel, Schema, start_server

    server = start_server(host='127.0.0.1', port=port)
    schema = Schema(name='std_msgs/msg/String', encoding='ros2msg', data=b'string data')
    channels = [Channel(f'/t{n}', schema=schema, message_encoding='cdr') for n in range(topics)]
    talk(rate, topics, lambda number, data: channels[number].log(data))
    server.stop()


def nothing(port, rate, topics):
    """Be the talker alone."""
    del port
    kept = [b''] * topics

    def send(number, data):
        kept[number] = data

    talk(rate, topics, send)


def talker(rate, topics):
    """Publish on a ROS graph, in a process of its own."""
    import rclpy
    from rclpy.qos import QoSProfile
    from std_msgs.msg import String

    rclpy.init()
    node = rclpy.create_node('talker')
    ends = [node.create_publisher(String, f'/t{n}', QoSProfile(depth=100)) for n in range(topics)]
    talk(rate, topics, lambda number, data: ends[number].publish(data))


class Reader:
    """Reads frames from a plain socket: a library would take longer for a message than a server."""

    def __init__(self, port):
        """Connect."""
        self.socket = opened(port)
        self.rest = b''
        self.ages, self.topics = [], 0

    def subscribe(self, text):
        """Subscribe to what is advertised."""
        told = json.loads(text)
        if told['op'] == 'advertise':
            rows = [c['id'] for c in told['channels'] if c['topic'].startswith('/t')]
            subscribe(self.socket, rows, self.topics)
            self.topics += len(rows)

    def read(self, end):
        """Take what comes until ``end`` [s, steady]; only ages of messages are kept."""
        while time.monotonic() < end:
            data = self.rest + self.socket.recv(1 << 20)
            now, at = time.monotonic_ns(), 0
            while at + 10 <= len(data):
                size, head = data[at + 1], 2
                if size == 126:
                    size, head = int.from_bytes(data[at + 2 : at + 4], 'big'), 4
                elif size == 127:
                    size, head = int.from_bytes(data[at + 2 : at + 10], 'big'), 10
                start = at + head
                if start + size > len(data):
                    break
                if data[at] == 0x82 and data[start] == 1 and size >= SIZE:
                    self.ages.append(now - int.from_bytes(data[start + 21 : start + 29], 'little'))
                elif data[at] == 0x81:
                    self.subscribe(data[start : start + size])
                at = start + size
            self.rest = data[at:]


def opened(port):
    """Return a connection that speaks the protocol."""
    made = socket.create_connection(('127.0.0.1', port))
    made.sendall(
        f'GET / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n'
        'Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n'
        f'Sec-WebSocket-Protocol: {SUBPROTOCOL}\r\n\r\n'.encode()
    )
    answer = b''
    while not answer.endswith(b'\r\n\r\n'):
        answer += made.recv(1)
    return made


def subscribe(made, channels, begin=0):
    """Ask for channels."""
    rows = [{'id': begin + n, 'channelId': c} for n, c in enumerate(channels)]
    said = json.dumps({'op': 'subscribe', 'subscriptions': rows}).encode()
    mask = bytes(4)
    size = len(said)
    head = bytes([0x80 | size]) if size < 126 else struct.pack('>BH', 0x80 | 126, size)
    made.sendall(b'\x81' + head + mask + said)


def stalled(port, topics):
    """Return a client that has asked for everything and never reads."""
    made = opened(port)
    made.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    subscribe(made, range(1, topics + 1))
    return made


def processor_time(pid):
    """Return what a process has used [s]."""
    fields = Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


def client(port):
    """Be a client: print messages per second and the quantiles of their ages."""
    reader = Reader(port)
    reader.read(time.monotonic() + 2.0)
    reader.ages.clear()
    begun = time.monotonic()
    reader.read(begun + SECONDS)
    print(json.dumps([len(reader.ages) / (time.monotonic() - begun), *quantiles(reader.ages)]))


def quantiles(ages):
    """Return median and 99th percentile [s]."""
    if len(ages) < 100:
        return float('nan'), float('nan')
    return 1e-9 * statistics.median(ages), 1e-9 * statistics.quantiles(ages, n=100)[98]


def free_port():
    """Return a port that is free."""
    with socket.socket() as trial:
        trial.bind(('127.0.0.1', 0))
        return trial.getsockname()[1]


def measure(name, command, port, topics, *, stall, own):  # noqa: PLR0913 - of a table
    """Measure one server, and print its row."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    other = None
    try:
        if name != 'nothing':
            for _ in range(300):
                try:
                    socket.create_connection(('127.0.0.1', port)).close()
                    break
                except OSError:
                    time.sleep(0.1)
            time.sleep(3.0 if name == 'graph' else 0.5)
            if stall:
                other = stalled(port, topics)
        reader = [sys.executable, __file__, 'client', str(port)]
        run = subprocess.Popen(reader, stdout=subprocess.PIPE) if name != 'nothing' else None
        time.sleep(2.5)
        used, begun = processor_time(process.pid), time.monotonic()
        time.sleep(SECONDS - 1.0)
        share = (processor_time(process.pid) - used) / (time.monotonic() - begun)
        if run is None:
            print(f'talker alone             {100 * share:5.1f} % of a core')
            return share
        came, median, p99 = json.loads(run.communicate()[0])
        words = 'and one stalled' if stall else 'one client'
        used = share - own
        each = 1e6 * used / came if came else float('nan')
        times = f'p50 {1e3 * median:6.1f} ms, p99 {1e3 * p99:6.1f} ms'
        print(f'{name:6} {words:15} {came:7.0f} messages/s, {times}, {100 * used:5.1f} % of a core'
              f', {each:5.1f} us each', flush=True)  # fmt: skip
    finally:
        process.kill()
        process.wait()
        if other is not None:
            other.close()
    return share


def main(rate, topics):
    """Measure all servers in turn."""
    print(f'{rate} messages/s of {SIZE} bytes on {topics} topics')
    here = [sys.executable, __file__]
    told = [str(rate), str(topics)]
    own = measure('nothing', [*here, 'nothing', '0', *told], 0, topics, stall=False, own=0.0)
    for stall in (False, True):
        for name in ('ours', 'sdk'):
            port = free_port()
            measure(name, [*here, name, str(port), *told], port, topics, stall=stall, own=own)
    speaker = subprocess.Popen([*here, 'talker', *told])
    try:
        for stall in (False, True):
            port = free_port()
            node = [sys.executable, '-m', 'agv_motion.cli.main', 'foxglove', '--port', str(port)]
            measure('graph', node, port, topics, stall=stall, own=0.0)
    finally:
        speaker.kill()


if __name__ == '__main__':
    ROLES = {'ours': ours, 'sdk': sdk, 'nothing': nothing, 'talker': talker, 'client': client}
    if sys.argv[1:] and sys.argv[1] in ROLES:
        ROLES[sys.argv[1]](*map(int, sys.argv[2:]))
    else:
        main(*([int(word) for word in sys.argv[1:]] or [20_000, 20]))
