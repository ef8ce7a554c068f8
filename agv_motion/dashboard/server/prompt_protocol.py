"""HTTP as uvicorn speaks it, but who connects and says nothing is soon sent away.

Uvicorn waits for the first request without end: a thousand silent connections would hold every file
descriptor of the process, and nobody could reach STOP.
"""

from __future__ import annotations

import resource
from collections import OrderedDict
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from uvicorn.protocols.http.h11_impl import H11Protocol

if TYPE_CHECKING:
    from asyncio import Transport

SILENCE = 10.0
"""[s] in which the first request must have come"""
MOST_SILENT = 100
"""connections that may wait for that; beyond, the one that is silent longest goes"""
DESCRIPTORS = 8192

_silent: OrderedDict[PromptProtocol, None] = OrderedDict()


class PromptProtocol(H11Protocol):
    """One connection."""

    def connection_made(self, transport: Transport) -> None:  # type: ignore[override]
        """Wait for the first request, but not for ever."""
        super().connection_made(transport)
        _silent[self] = None
        if len(_silent) > MOST_SILENT:
            oldest, _ = _silent.popitem(last=False)
            oldest.transport.abort()
        self._deadline = self.loop.call_later(SILENCE, self._end_if_silent)

    def data_received(self, data: bytes) -> None:
        """Take what has come; with a whole request the connection is silent no more."""
        super().data_received(data)
        if self.cycle is not None or self.transport.get_protocol() is not self:
            self._speak()

    def connection_lost(self, exc: Exception | None) -> None:
        """Forget the connection."""
        self._speak()
        super().connection_lost(exc)

    def _speak(self) -> None:
        _silent.pop(self, None)
        self._deadline.cancel()

    def _end_if_silent(self) -> None:
        if _silent.pop(self, self) is None:
            self.transport.abort()


def allow_descriptors() -> None:
    """Let this process open as many files as it may, up to `DESCRIPTORS`."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted: Any = DESCRIPTORS if hard == resource.RLIM_INFINITY else min(hard, DESCRIPTORS)
    if soft < wanted:
        with suppress(OSError, ValueError):
            resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
