"""Run the real `agv` command beside the graph of the test."""

from __future__ import annotations

import ctypes
import fcntl
import gc
import json
import os
import pty
import re
import select
import socket
import struct
import subprocess
import sys
import termios
import time
from functools import partial
from pathlib import Path

import pyte
import pytest

ADOPT_ORPHANS = 36
"""PR_SET_CHILD_SUBREAPER of Linux: a process whose parent has ended becomes a child of ours"""


class WarmPython:
    """The one process that has imported all; it is started when it is first needed."""

    def __init__(self):
        ctypes.CDLL(None).prctl(ADOPT_ORPHANS, 1)
        self.line, other = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with other:
            command = [sys.executable, Path(__file__).with_name('warm_python.py')]
            self._process = subprocess.Popen(command, stdin=other)  # noqa: S603 - our own

    def fork(self, request, streams):
        """Return the number of a process, our child, that runs what is asked for."""
        socket.send_fds(self.line, [json.dumps(request).encode()], streams)
        number = int.from_bytes(self.line.recv(4), 'little')
        assert number, 'the warm Python has ended'
        return number

    def end(self):
        """Let it end."""
        self.line.close()
        self._process.wait()


class ForkedProcess(subprocess.Popen):
    """A process as any other, but forked by a `WarmPython`."""

    def __init__(self, warm_python, arguments, **options):
        self._warm_python = warm_python
        super().__init__(arguments, **options)

    def _execute_child(self, args, _executable, _call, _close, _pass, cwd, env, *given):
        """Ask for the process; of what is ``given`` the pipes and the wish for a session count."""
        pipes, session = given[3:9], given[14]
        request = {
            'arguments': args,
            'folder': str(cwd or Path.cwd()),
            'environment': dict(env or os.environ),
            'session': session,
        }
        streams = [own if own >= 0 else i for i, own in enumerate((pipes[0], pipes[3], pipes[5]))]
        self.pid = self._warm_python.fork(request, streams)
        self._child_created = True
        self._close_pipe_fds(*pipes)


class Agv:
    """Starts `agv` with arguments and spins the graph until it ends."""

    def __init__(self, warm_python, graph=None):
        self.warm_python = warm_python
        self.graph = graph
        self.processes = []

    def start(self, *arguments, cold=False, **options):
        """Start the command and return its process; a ``cold`` one imports all by itself."""
        options = {'stdout': subprocess.PIPE, 'stderr': subprocess.PIPE, 'text': True} | options
        words = [*map(str, arguments)]
        if cold:
            words = [sys.executable, '-m', 'agv_motion.cli.main', *words]
            process = subprocess.Popen(words, **options)  # noqa: S603 - our own command
        else:
            process = ForkedProcess(self.warm_python, words, **options)
        self.processes.append(process)
        return process

    def __call__(self, *arguments, timeout=120.0, **options):
        """Return exit status, output and errors of the command."""
        process = self.start(*arguments, **options)
        if self.graph is not None:
            self.graph.spin_until(lambda: process.poll() is not None, timeout)
        out, errors = process.communicate(timeout=timeout)
        return process.returncode, out, errors

    def end(self):
        """Leave no process behind, whatever became of the test."""
        for process in self.processes:
            if process.poll() is None:
                process.kill()
            process.communicate()


JARRING = re.compile(r'-0\.?0*(?![\d.])|\.\.\.|\b0\.0 times')
"""Numbers that round to zero with a minus, what was cut off, and a pace of nothing"""


PROGRESS = re.compile(r'\d %$')


def whole(lines):
    """Return whether lines are a live picture from the frame of its map down to its last line.

    A picture is erased from below before the next one is written: one that is half written has no
    last line yet, however long its writer is held up.
    """
    told = [line.rstrip() for line in lines if line.strip()]
    frame = [line[0] for line in told if line[0] in '┌│└╭╰']
    return bool(told and PROGRESS.search(told[-1]) and len(frame) > 3)


def frame_ends(lines):
    """Return the columns at which the frame of the map in ``lines`` ends: one, or it jumps."""
    return {line.find('│', 1) for line in lines if line.startswith('│') and '│' in line[1:]}


class Terminal:
    """Runs a command of `agv` in a real terminal (a pty), and reads its screen as it changes."""

    def __init__(self, agv, *words, columns=80, rows=24, **options):
        self._master, self._slave = pty.openpty()
        self._modes = termios.tcgetattr(self._slave)
        self.screen = pyte.HistoryScreen(columns, rows, history=5000)
        self._stream = pyte.ByteStream(self.screen)
        self.pictures = []
        """the screen after each thing that was written, size and lines"""
        self._old_frame = set()
        """the columns at which the map's frame ended before the terminal got its size"""
        self._resize(columns, rows)
        streams = dict.fromkeys(('stdin', 'stdout', 'stderr'), self._slave)
        self.process = agv.start(*words, start_new_session=True, **streams, **options)

    def _resize(self, columns, rows):
        fcntl.ioctl(self._slave, termios.TIOCSWINSZ, struct.pack('4H', rows, columns, 0, 0))

    def read(self, seconds=0.1):
        """Show what is written now; return whether anything was.

        A picture is what is whole, and what the terminal's own ^C does not stand in: that comes
        wherever the writer is, and moves the rest of its line.
        """
        if not select.select([self._master], [], [], seconds)[0]:
            return False
        self._stream.feed(os.read(self._master, 65536))
        shown = self.screen.display[:]
        echoed = any('^C' in line for line in shown)
        if whole(shown) and not echoed and frame_ends(shown) != self._old_frame:
            self.pictures.append(((self.screen.columns, self.screen.lines), shown))
        return True

    def wait(self, seen, limit=120.0):
        """Read until ``seen`` of the text on the screen; return its lines."""
        end = time.monotonic() + limit
        while not seen('\n'.join(self.screen.display)):
            assert self.read(1.0) or self.process.poll() is None, self.told()
            assert time.monotonic() < end, self.told()
        return self.screen.display[:]

    def picture(self, limit=120.0):
        """Read until a live picture of the terminal's size stands whole; return its lines."""
        size, before = (self.screen.columns, self.screen.lines), len(self.pictures)
        end = time.monotonic() + limit
        while not (found := [lines for shown, lines in self.pictures[before:] if shown == size]):
            assert self.read(1.0) or self.process.poll() is None, self.told()
            assert time.monotonic() < end, self.told()
        return found[-1]

    def resize(self, columns, rows):
        """Give the terminal another size while the command runs: its frame must follow."""
        self._old_frame = frame_ends(self.pictures[-1][1]) if self.pictures else set()
        self.screen.resize(rows, columns)
        self._resize(columns, rows)

    def press(self, keys):
        """Press keys, once all that was written is read.

        Ctrl-C throws away what a terminal still holds, and cuts a write that waits for room.
        """
        while self.read(0.0):
            pass
        os.write(self._master, keys)

    def end(self, limit=180.0):
        """Read until the command has ended; return its status and all that the terminal shows.

        The terminal must be as it was: its modes, and a cursor that can be seen.
        """
        until = time.monotonic() + limit
        while self.process.poll() is None:
            assert time.monotonic() < until, self.told()
            self.read(0.2)
        while self.read():
            pass
        assert termios.tcgetattr(self._slave) == self._modes
        assert not self.screen.cursor.hidden
        os.close(self._slave)
        os.close(self._master)
        return self.process.returncode, self.told()

    def told(self):
        """Return the text of the whole terminal, also of what has scrolled away."""
        columns = range(self.screen.columns)
        past = (''.join(line[x].data for x in columns) for line in self.screen.history.top)
        return '\n'.join([line.rstrip() for line in (*past, *self.screen.display)])

    def frames(self):
        """Return for each size of the terminal the columns at which the map's frame ended.

        None may jump, and no number may be cut off or show a minus before zero.
        """
        found = {}
        for size, lines in self.pictures:
            for line in lines:
                assert not JARRING.search(line), line
            found[size] = found.get(size, set()) | frame_ends(lines)
        assert all(len(ends) == 1 for ends in found.values()), found
        return found


@pytest.fixture(scope='session')
def warm_python():
    """Return what makes processes of `agv` at once."""
    warm = WarmPython()
    yield warm
    warm.end()


@pytest.fixture(scope='module')
def alone(warm_python):
    """Return the command without a graph beside it."""
    gc.collect()  # a node of the last module that waits for it is still on the graph
    agv = Agv(warm_python)
    yield agv
    agv.end()


@pytest.fixture
def terminal(alone):
    """Return what runs the command in a terminal."""
    return partial(Terminal, alone)


@pytest.fixture
def agv(graph, warm_python):
    """Return the command beside a graph that is spun while it runs."""
    agv = Agv(warm_python, graph)
    yield agv
    agv.end()


@pytest.fixture(scope='session')
def oak(warm_python):
    """Return the name of a node that runs, in a process of its own."""
    agv = Agv(warm_python)
    name = '/oak/wheel_kinematics'
    agv.start('run', 'wheel_kinematics', '--ros-args', '-r', '__ns:=/oak', '-p', 'rate:=2.0',
              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
    while agv('lifecycle', 'get', name)[1] != 'active [3]\n':
        assert agv.processes[0].poll() is None
    yield name
    agv.end()
