"""What trials of the operator's page share: robot, server and browser as real processes.

Times are those of the one clock of this machine: when the hand moved, as the browser noted it, and
when the wheels were commanded zero, as a listener on the ROS graph heard it.
"""

from __future__ import annotations

import select
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

import rclpy
from geometry_msgs.msg import TwistStamped
from rclpy.experimental import EventsExecutor
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import JointState

from agv_motion.ros.qos import COMMAND

ROOT = Path(__file__).parents[2]
CHROMIUM = shutil.which('chromium') or ''
FLAGS = [
    '--no-sandbox', '--headless', '--disable-gpu', '--disable-quic', '--no-first-run',
    '--disable-background-networking', '--disable-component-update', '--disable-sync',
]  # fmt: skip
READY = 90.0
"""[s] within which a process must be there"""
NOTE = """const note = () => { window.acted = performance.timeOrigin + performance.now(); };
for (const kind of ['pointerdown', 'pointerup', 'keydown', 'keyup']) {
  window.addEventListener(kind, note, { capture: true });
}"""


class Wheels:
    """Hears what the wheels of the tree are commanded, and makes it walk, in a thread."""

    def __init__(self):
        """Join the graph."""
        self.context = rclpy.Context()
        rclpy.init(context=self.context, signal_handler_options=SignalHandlerOptions.NO)
        self.node = rclpy.create_node(
            'page_trial', context=self.context, start_parameter_services=False, enable_rosout=False
        )
        self.node.create_subscription(JointState, '/oak/turrets/command', self._hear, COMMAND)
        self.agent = self.node.create_publisher(TwistStamped, '/oak/cmd_vel/agent', COMMAND)
        self.node.create_timer(0.1, self._walk)
        self.walking = False
        self.changes = []
        """when [s], and whether a wheel rolls from then on"""
        self.heard = threading.Condition()
        self.ended = False
        self.thread = threading.Thread(target=self._spin)
        self.thread.start()

    def close(self):
        """Leave the graph."""
        self.ended = True
        self.thread.join()
        self.node.destroy_node()
        rclpy.shutdown(context=self.context)

    def rolls(self):
        """Return whether a wheel is commanded to roll."""
        return bool(self.changes) and self.changes[-1][1]

    def wait(self, condition, timeout=20.0):
        """Wait until something is so, and return it; the wheels' words wake who waits."""
        with self.heard:
            found = self.heard.wait_for(condition, timeout)
        assert found, f'not so within {timeout} s; the wheels last: {self.changes[-3:]}'
        return found

    def stood_after(self, moment, timeout=30.0):
        """Return how long after a moment the wheels were commanded zero, for good [s]."""
        self.wait(lambda: self.changes and not self.changes[-1][1], timeout)
        return max(self.changes[-1][0] - moment, 0.0)

    def _spin(self):
        executor = EventsExecutor(context=self.context)
        executor.add_node(self.node)
        while not self.ended:
            executor.spin_once(timeout_sec=0.05)
        executor.shutdown()

    def _hear(self, message):
        now, rolls = time.time(), any(message.velocity)
        if not self.changes or self.changes[-1][1] is not rolls:
            with self.heard:
                self.changes.append((now, rolls))
                self.heard.notify_all()

    def _walk(self):
        if self.walking:
            message = TwistStamped()
            message.header.frame_id = 'base_link'
            message.twist.linear.x = 0.01
            self.agent.publish(message)


class Cable:
    """A line between browser and server that can be cut: nothing is closed, nothing arrives."""

    def __init__(self, port):
        """Lead to a port of this machine."""
        self.target = port
        self.listener = socket.create_server(('127.0.0.1', 0))
        self.port = self.listener.getsockname()[1]
        self.lines = {}
        self.is_cut = self.ended = False
        self.thread = threading.Thread(target=self._run)
        self.thread.start()

    def cut(self):
        """Cut it."""
        self.is_cut = True

    def mend(self):
        """Join it again; what was on it is lost, with its connections."""
        for line in list(self.lines):
            with suppress(OSError):
                line.shutdown(socket.SHUT_RDWR)
        self.is_cut = False

    def close(self):
        """End."""
        self.ended = True
        self.thread.join()
        for one in (self.listener, *self.lines):
            one.close()

    def _run(self):
        while not self.ended:
            ready, _, _ = select.select([self.listener, *self.lines], [], [], 0.05)
            if self.is_cut:
                time.sleep(0.01)
                continue
            for line in ready:
                self._open() if line is self.listener else self._carry(line)

    def _open(self):
        near, _ = self.listener.accept()
        try:
            far = socket.create_connection(('127.0.0.1', self.target))
        except OSError:
            near.close()
            return
        self.lines[near], self.lines[far] = far, near

    def _carry(self, line):
        other = self.lines.get(line)
        if other is None:
            return
        with suppress(OSError):
            if data := line.recv(65536):
                other.sendall(data)
                return
        for one in (line, other):
            self.lines.pop(one, None)
            one.close()


class Process:
    """A process of ours that says when it is ready."""

    def __init__(self, *command, ready):
        """Start it, and wait until it says so."""
        self.process = subprocess.Popen(  # noqa: S603 - our own command
            [sys.executable, *command], cwd=ROOT, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip
        self.said = []
        self.there = threading.Event()
        self.reader = threading.Thread(target=self._read, args=(ready,), daemon=True)
        self.reader.start()
        if not self.there.wait(READY) or self.process.poll() is not None:
            self.end()
            msg = f'{command} did not get ready:\n{"".join(self.said[-20:])}'
            raise RuntimeError(msg)

    def end(self, how=signal.SIGTERM):
        """End it, and wait for it."""
        with suppress(ProcessLookupError):
            self.process.send_signal(how)
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.reader.join()
        self.process.stdout.close()

    def _read(self, ready):
        for line in self.process.stdout:
            self.said.append(line)
            if ready in line:
                self.there.set()
        self.there.set()


def free_port():
    """Return a port of this machine that nobody listens on."""
    with socket.create_server(('127.0.0.1', 0)) as free:
        return free.getsockname()[1]


class Rig:
    """Robot, server, cable and browser."""

    def __init__(self, browser, folder, stack):
        """Start all; ``stack`` ends them."""
        self.browser, self.folder = browser, folder
        self.wheels = Wheels()
        stack.callback(self.wheels.close)
        self.port = free_port()
        self.cable = Cable(self.port)
        stack.callback(self.cable.close)
        self.robot = Process(str(ROOT / 'launch_scripts' / 'page' / 'page_robot.py'), ready='ready')
        stack.callback(self.robot.end)
        self.serve()
        stack.callback(lambda: self.server.end())  # noqa: PLW0108 - of the last server

    @property
    def url(self):
        """Of the page, through the cable."""
        return f'http://127.0.0.1:{self.cable.port}'

    def serve(self):
        """Start the server, or start it again on the same port."""
        self.server = Process(
            '-m', 'agv_motion.nodes.dashboard', '--ros-args', '-p', f'port:={self.port}',
            '-p', f'state_folder:={self.folder}', ready='the page is at',
        )  # fmt: skip

    @contextmanager
    def page(self, size=(1024, 768), *, away='', **options):
        """Yield an open page of a new browser profile that shows the tree."""
        width, height = size
        context = self.browser.new_context(viewport={'width': width, 'height': height}, **options)
        context.set_default_timeout(60000)
        context.add_init_script(NOTE)
        page = context.new_page()
        try:
            page.goto(self.url + away)
            page.wait_for_selector('[data-act=drive]')
            yield page
        finally:
            context.close()

    def press(self, page):
        """Push the stick forward, and wait until the wheels roll."""
        page.locator('.stick-both').hover()
        box = page.locator('.stick-both').bounding_box()
        page.mouse.down()
        page.mouse.move(box['x'] + box['width'] / 2, box['y'] + 4)
        self.wheels.wait(self.wheels.rolls)

    def open_drive(self, page):
        """Open the drive panel, and wait until its line is open."""
        page.click('[data-act=drive]')
        page.locator('.drive-state', has_text='hold to drive').wait_for()


def acted(page):
    """Return when the hand last moved [s since 1970], as the browser noted it."""
    return page.evaluate('window.acted') / 1000.0


@contextmanager
def rig(browser, folder):
    """Yield a rig; everything is ended after it."""
    with ExitStack() as stack:
        yield Rig(browser, folder, stack)
