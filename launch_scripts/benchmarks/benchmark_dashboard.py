"""What the page's server costs, beside foxglove-sdk's server and a bare websocket, in one run.

Three robots speak at 10 Hz; one client looks, then ten, of which one never reads and one is 200 ms
away. Told are the processor time of each server per second, and for the page how old what a good
client sees is. Needs the extras dashboard and benchmark.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROBOTS = ('oak', 'ash', 'elm')
RATE = 10.0
SECONDS = 12.0
"""[s] of each measurement"""
LATENCY = 0.2
"""[s] of the client that is far away"""
PORTS = {'page': 18080, 'foxglove': 18081, 'bare': 18082}


def messages():
    """Return what a robot says: topic, type, and whether ten times a second or once."""
    from diagnostic_msgs.msg import DiagnosticStatus
    from geometry_msgs.msg import PoseWithCovarianceStamped, TwistStamped, Vector3Stamped
    from nav_msgs.msg import Odometry
    from sensor_msgs.msg import JointState
    from std_msgs.msg import String

    names = [f'turret_{i}_{what}' for what in ('steering', 'wheel') for i in range(3)]
    joints = JointState(name=names, position=[0.1] * 6, velocity=[0.2] * 6)
    fast = {
        'turrets/state': joints, 'turrets/command': joints, 'odom': Odometry(),
        'pose': PoseWithCovarianceStamped(), 'cmd_vel': TwistStamped(),
        'cmd_vel/limited': TwistStamped(), 'granier/sap_flow': Vector3Stamped(),
    }  # fmt: skip
    slow = {'state': String(data='walking'), 'driver': DiagnosticStatus(message='agent drives')}
    return [(topic, m, True) for topic, m in fast.items()] + [
        (t, m, False) for t, m in slow.items()
    ]


def talk():
    """Be three robots, until killed."""
    import rclpy

    rclpy.init()
    node = rclpy.create_node('robots')
    said = [
        (node.create_publisher(type(message), f'/{robot}/{topic}', 5), message, fast)
        for robot in ROBOTS
        for topic, message, fast in messages()
    ]
    for count in range(10**9):
        begun = time.monotonic()
        stamp = node.get_clock().now().to_msg()
        for publisher, message, fast in said:
            if fast or count % RATE == 0:
                if hasattr(message, 'header'):
                    message.header.stamp = stamp
                publisher.publish(message)
        time.sleep(max(1.0 / RATE - (time.monotonic() - begun), 0.0))


def forward(open_server):
    """Be a server that passes every message on as it comes, until killed."""
    import rclpy
    from rclpy.experimental import EventsExecutor

    rclpy.init()
    node = rclpy.create_node('forwarder')
    for robot in ROBOTS:
        for topic, message, _ in messages():
            send = open_server(f'/{robot}/{topic}')
            node.create_subscription(type(message), f'/{robot}/{topic}', send, 5, raw=True)
    executor = EventsExecutor()
    executor.add_node(node)
    while True:
        executor.spin_once(timeout_sec=0.1)


def foxglove():
    """Be foxglove-sdk's server."""
    from foxglove import Channel, Schema, start_server

    server = start_server(host='127.0.0.1', port=PORTS['foxglove'])
    try:
        kind = Schema(name='Bytes', encoding='ros2msg', data=b'byte[] data')
        forward(lambda topic: Channel(topic, schema=kind, message_encoding='cdr').log)
    finally:
        server.stop()


def bare():
    """Be nothing but a websocket."""
    import threading

    from websockets.asyncio.server import broadcast, serve

    loop = asyncio.new_event_loop()
    clients = set()

    async def client(connection):
        clients.add(connection)
        await connection.wait_closed()
        clients.discard(connection)

    async def run():
        async with serve(client, '127.0.0.1', PORTS['bare'], compression=None):
            await asyncio.Future()

    threading.Thread(target=lambda: loop.run_until_complete(run()), daemon=True).start()
    forward(lambda _: lambda data: loop.call_soon_threadsafe(broadcast, clients, data))


def processor_time(process):
    """Return what a process has used [s]."""
    fields = Path(f'/proc/{process.pid}/stat').read_text().rpartition(')')[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


async def look(name, ages, delay=0.0):
    """Be a client; note how old what it sees is."""
    from websockets.asyncio.client import connect

    path = '/live' if name == 'page' else ''
    protocols = ['foxglove.sdk.v1'] if name == 'foxglove' else None
    url = f'ws://127.0.0.1:{PORTS[name]}{path}'
    async with connect(url, max_size=None, compression=None, subprotocols=protocols) as live:
        subscribed = 0
        async for text in live:
            if name == 'page':
                told = json.loads(text)
                if told['kind'] == 'frame':
                    await asyncio.sleep(delay / 2)
                    ages += [told['now'] - one['at'] + delay / 2 for one in told['updates']
                             if one['topic'] in {'pose', 'turrets', 'twist'}]  # fmt: skip
                    await asyncio.sleep(delay / 2)
                    await live.send(json.dumps({'ack': told['n']}))
            elif name == 'foxglove' and isinstance(text, str) and 'advertise' in text:
                channels = json.loads(text).get('channels', [])
                rows = [{'id': subscribed + i, 'channelId': c['id']}
                        for i, c in enumerate(channels)]  # fmt: skip
                subscribed += len(rows)
                await live.send(json.dumps({'op': 'subscribe', 'subscriptions': rows}))


def stalled(name):
    """Return a client that has asked for everything and never reads."""
    made = socket.create_connection(('127.0.0.1', PORTS[name]))
    path = '/live' if name == 'page' else '/'
    host = f'127.0.0.1:{PORTS[name]}'
    made.sendall(
        f'GET {path} HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n'
        'Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n'.encode()
    )
    return made


async def measure(name, process, clients):
    """Return processor time per second of a server, and the ages that the first client saw [s]."""
    ages: list[float] = []
    tasks = [asyncio.create_task(look(name, ages if i == 0 else [], LATENCY * (i == 1)))
             for i in range(clients - (clients > 1))]  # fmt: skip
    other = stalled(name) if clients > 1 else None
    await asyncio.sleep(3.0)
    ages.clear()
    used, begun = processor_time(process), time.monotonic()
    await asyncio.sleep(SECONDS)
    share = (processor_time(process) - used) / (time.monotonic() - begun)
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)
    if other is not None:
        other.close()
    return share, ages


def wait_for(port):
    """Wait until a server listens, and has met the robots."""
    for _ in range(600):
        with contextlib.suppress(OSError), socket.create_connection(('127.0.0.1', port)):
            break
        time.sleep(0.1)
    time.sleep(3.0)


def servers(state):
    """Yield name and command of each server that is installed."""
    page = ['dashboard', '--port', str(PORTS['page']), '--state-folder', state]
    yield 'page', [sys.executable, '-m', 'agv_motion.cli.main', *page]
    yield 'bare', [sys.executable, __file__, 'bare']
    try:
        import foxglove as _  # noqa: F401
    except ImportError:
        print('foxglove-sdk is not installed: pip install foxglove-sdk')
        return
    yield 'foxglove', [sys.executable, __file__, 'foxglove']


def main():
    """Measure, and print a table."""
    talker = subprocess.Popen([sys.executable, __file__, 'talk'])
    try:
        with tempfile.TemporaryDirectory() as state:
            for name, command in servers(state):
                process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
                wait_for(PORTS[name])
                for clients in (1, 10):
                    share, ages = asyncio.run(measure(name, process, clients))
                    old = ''
                    if ages:
                        p99 = statistics.quantiles(ages, n=100)[98]
                        old = f', what is seen is {statistics.median(ages):.3f} s old, '
                        old += f'{p99:.3f} s at p99'
                    print(f'{name:9} {clients:2} clients: {100 * share:5.1f} % of a core{old}')
                process.terminate()
                process.wait()
    finally:
        talker.kill()


if __name__ == '__main__':
    {'talk': talk, 'bare': bare, 'foxglove': foxglove}.get(''.join(sys.argv[1:]), main)()
