"""Run the real `agv` command beside the graph of the test."""

from __future__ import annotations

import signal
import subprocess
import sys

import pytest


class Agv:
    """Starts `agv` with arguments and spins the graph until it ends."""

    def __init__(self, graph=None):
        self.graph = graph

    def start(self, *arguments, **options):
        """Start the command and return its process."""
        return subprocess.Popen(  # noqa: S603 - our own command
            [sys.executable, '-m', 'agv_motion.cli.main', *map(str, arguments)],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options,
        )  # fmt: skip

    def __call__(self, *arguments, interrupt_after=0.0, timeout=60.0):
        """Return exit status, output and errors of the command."""
        process = self.start(*arguments)
        if self.graph is not None:
            if interrupt_after:
                self.graph.spin_for(interrupt_after)
                process.send_signal(signal.SIGINT)
            self.graph.spin_until(lambda: process.poll() is not None, timeout)
        out, errors = process.communicate(timeout=timeout)
        return process.returncode, out, errors


@pytest.fixture(scope='module')
def alone():
    """Return the command without a graph beside it."""
    return Agv()


@pytest.fixture
def agv(graph):
    """Return the command beside a graph that is spun while it runs."""
    return Agv(graph)
