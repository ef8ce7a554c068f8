"""One client of `/foxglove`: what it has asked for, and its wire."""

from __future__ import annotations

import asyncio
import time
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.foxglove import protocol
from agv_motion.dashboard.foxglove.frames import frame
from agv_motion.dashboard.foxglove.protocol import NO_GRAPH, Severity
from agv_motion.dashboard.foxglove.subscriptions import Subscriptions
from agv_motion.errors import AgvMotionError, shortened

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine, Iterable, Sequence

    from agv_motion.dashboard.foxglove.channels import LiveChannel
    from agv_motion.dashboard.foxglove.permissions import Permissions
    from agv_motion.dashboard.foxglove.requests import ClientChannel
    from agv_motion.dashboard.server.foxglove.wire import Wire

MOST_WAITING = 8 * 1024 * 1024
"""[bytes] of answers that a client may leave untaken before it is sent away"""
MOST_TASKS = 16
"""requests that may be under way at once"""
TOLD = 5
"""refusals of one request that are told one by one: its thousands would keep others waiting"""
MOST_CHANNELS = 50
"""topics on which one client may publish"""


class FoxgloveClient:
    """What is known of one client."""

    def __init__(
        self, wire: Wire, permissions: Permissions, name: str = '',
        welcome: Callable[[], bool] = lambda: True,
    ) -> None:  # fmt: skip
        """Begin with nothing asked.

        Args:
            wire: The way to it.
            permissions: What it may do.
            name: Of its user.
            welcome: Returns whether its session still holds.

        """
        self.wire, self.permissions, self.name, self.welcome = wire, permissions, name, welcome
        self.subscriptions = Subscriptions()
        self.published: dict[int, ClientChannel] = {}
        self.watched: set[str] = set()
        """parameters whose changes it wants to be told; `ALL`: of any"""
        self.graph = NO_GRAPH
        """as it was told"""
        self.watches_graph = False
        self._tasks: set[asyncio.Task[None]] = set()

    def send(self, message: str | bytes) -> None:
        """Send a text or bytes; who leaves too much untaken is sent away."""
        if self.wire.waiting > MOST_WAITING:
            self.wire.cut()
            return
        self.wire.write((frame(message),))

    def tell(self, level: Severity, text: str, number: str = '') -> None:
        """Tell it something in words."""
        self.send(protocol.status(level, text, number))

    def refuse(self, why: object) -> None:
        """Tell it what was not done."""
        self.tell(Severity.ERROR, shortened(str(why)))

    def refuse_each(self, reasons: Sequence[str]) -> None:
        """Tell it why parts of a request were not done, of many only some."""
        for why in reasons[:TOLD]:
            self.refuse(why)
        if len(reasons) > TOLD:
            self.refuse(f'and {len(reasons) - TOLD} more of the same request are refused')

    def serve(self, fresh: Iterable[LiveChannel], count: int, time: bytes | None) -> None:
        """Send what is new, if it has taken what was sent before.

        Args:
            fresh: Channels with news since the last look.
            count: Number of the newest message of all.
            time: Of the robots, as it is told; None: it has not changed.

        """
        wire, subscriptions = self.wire, self.subscriptions
        if not subscriptions.by_channel and time is None:
            return
        if wire.waiting:
            subscriptions.skip()
            return
        parts = subscriptions.frames(fresh, count)
        if time is not None:
            parts.insert(0, time)
        if parts:
            wire.write(parts)

    def catch_up(self, count: int) -> None:
        """Send what it has missed, where nothing new has come meanwhile."""
        if self.subscriptions.is_behind:
            self.serve((), count, None)

    def begin(self, work: Coroutine[Any, Any, None]) -> None:
        """Let an answer come later; what goes wrong is told."""
        if len(self._tasks) >= MOST_TASKS:
            work.close()
            self.refuse(f'{MOST_TASKS} requests are under way: wait for their answers')
            return
        task = asyncio.create_task(self._guarded(work))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        task.add_done_callback(lambda _: work.close())  # one that was never begun

    async def _guarded(self, work: Coroutine[Any, Any, None]) -> None:
        try:
            await work
        except AgvMotionError as error:
            self.refuse(error)

    def close(self) -> None:
        """Let nothing come any more."""
        for task in self._tasks:
            task.cancel()


ALL = '*'
"""in place of the name of a parameter"""
REFRESH = 2.0
"""[s] after which it is looked whether a client is still welcome"""


class Renewal:
    """Looks now and then whether clients are still welcome."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        """Look first after a while."""
        self._clock = clock
        self._at = clock() + REFRESH

    def is_due(self) -> bool:
        """Return whether it is time to look."""
        now = self._clock()
        if now < self._at:
            return False
        self._at = now + REFRESH
        return True
