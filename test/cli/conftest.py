"""Run the real `agv` command beside the graph of the test."""

from __future__ import annotations

import subprocess
import sys

import pytest


class Agv:
    """Starts `agv` with arguments and spins the graph until it ends."""

    def __init__(self, graph=None):
        self.graph = graph
        self.processes = []

    def start(self, *arguments, **options):
        """Start the command and return its process."""
        process = subprocess.Popen(  # noqa: S603 - our own command
            [sys.executable, '-m', 'agv_motion.cli.main', *map(str, arguments)],
            **{'stdout': subprocess.PIPE, 'stderr': subprocess.PIPE, 'text': True, **options},
        )  # fmt: skip
        self.processes.append(process)
        return process

    def __call__(self, *arguments, timeout=120.0):
        """Return exit status, output and errors of the command."""
        process = self.start(*arguments)
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


@pytest.fixture(scope='module')
def alone():
    """Return the command without a graph beside it."""
    agv = Agv()
    yield agv
    agv.end()


@pytest.fixture
def agv(graph):
    """Return the command beside a graph that is spun while it runs."""
    agv = Agv(graph)
    yield agv
    agv.end()
