"""The operator's page beside a demo: a process of its own, which ends with it however it ends."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import threading
import time
import webbrowser
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from rich.console import Console

HOST, PORT = '127.0.0.1', 8080
NEXT_PORTS = 20
"""that are tried where the first is taken"""
NEEDED = ('starlette', 'uvicorn', 'websockets', 'argon2')
PATIENCE = 30.0
"""[s] in which the page must be there to be opened"""
ENDING = 5.0
"""[s] in which it must have ended"""


@contextmanager
def page(bag: Path, console: Console, *, wanted: bool = True) -> Iterator[None]:
    """Serve the page as long as the context lasts, if it is ``wanted`` and installed.

    Args:
        bag: Of the demo, to look back into.
        console: Tells where the page is, or why there is none.
        wanted: Whether there shall be one.

    """
    port = free_port() if wanted else None
    missing = [name for name in NEEDED if find_spec(name) is None]
    if not wanted:
        yield
        return
    if missing or port is None:
        why = f'{missing[0]} is missing: pip install "agv_motion[dashboard]"' if missing else (
            f'ports {PORT} to {PORT + NEXT_PORTS - 1} are taken')  # fmt: skip
        console.print(f"No operator's page: {why}.")
        yield
        return
    url = f'http://{HOST}:{port}'
    console.print(f"Operator's page: {url} (in a few seconds; --no-page leaves it)")
    process = _start(bag, port)
    try:
        if console.is_terminal and (os.environ.get('DISPLAY') or os.environ.get('WAYLAND_DISPLAY')):
            threading.Thread(target=_open, args=(port, url), daemon=True).start()
        yield
    finally:
        _end(process)


def free_port() -> int | None:
    """Return the first port that is free; None if none is."""
    for port in range(PORT, PORT + NEXT_PORTS):
        with socket.socket() as trial, suppress(OSError):
            trial.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            trial.bind((HOST, port))
            return port
    return None


def _start(bag: Path, port: int) -> subprocess.Popen[bytes]:
    """Start the page; it ends when the pipe to it is closed, as at the death of this process."""
    words = ['dashboard', '--port', str(port), '--bag', str(bag.resolve()), '--end-with-stdin']
    return subprocess.Popen(  # noqa: S603 - our own
        [sys.executable, '-m', 'agv_motion.cli.main', *words],
        stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        start_new_session=True,  # Ctrl-C is for the demo, which then ends the page
    )  # fmt: skip


def _end(process: subprocess.Popen[bytes]) -> None:
    if process.stdin is not None:
        process.stdin.close()
    try:
        process.wait(ENDING)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _open(port: int, url: str) -> None:
    """Open the page in a browser, as soon as it answers."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        with suppress(OSError), socket.create_connection((HOST, port), 1.0):
            webbrowser.open(url)
            return
        time.sleep(0.2)
