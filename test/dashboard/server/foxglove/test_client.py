"""What one client may leave untaken and ask at once has an end."""

from __future__ import annotations

import asyncio
import inspect
from types import SimpleNamespace as Some

from agv_motion.dashboard.foxglove.permissions import Permissions
from agv_motion.dashboard.server.foxglove import client
from agv_motion.dashboard.server.foxglove.client import FoxgloveClient, Renewal


class Stalled:
    """A wire that takes what it is given, and passes nothing on."""

    def __init__(self):
        self.waiting, self.is_cut = 0, False

    def write(self, frames):
        self.waiting += len(b''.join(frames))

    def cut(self):
        self.is_cut = True


def test_who_leaves_too_many_answers_untaken_is_sent_away():
    wire = Stalled()
    one = FoxgloveClient(wire, Permissions())
    for _ in range(10_000):
        if wire.is_cut:
            break
        one.refuse('x' * 900)
    assert wire.is_cut
    assert wire.waiting < client.MOST_WAITING + 2000


def test_requests_under_way_are_counted(tool, robots, monkeypatch):
    monkeypatch.setattr(client, 'MOST_TASKS', 0)
    tool.ask('getParameters', parameterNames=[])
    assert '0 requests are under way' in tool.refusal()


def test_a_session_is_looked_at_now_and_then():
    times = [0.0, 1.0, 2.5, 2.6, 5.0]
    renewal = Renewal(lambda: times.pop(0))
    assert [renewal.is_due() for _ in range(4)] == [False, True, False, True]


def test_a_request_of_a_client_that_leaves_at_once_is_closed(run_apart):
    """Its task is cancelled before it is begun."""
    begun = []

    async def work():
        begun.append(True)

    async def leave():
        client, request = FoxgloveClient(Some(), Permissions()), work()
        client.begin(request)
        client.close()
        await asyncio.sleep(0)
        await asyncio.sleep(0)
        return inspect.getcoroutinestate(request)

    assert run_apart(leave()) == inspect.CORO_CLOSED
    assert begun == []
