"""Acts that came before: the same request again is answered again, and not done again."""

from __future__ import annotations

import hashlib
import time
from collections import OrderedDict
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.dashboard.server.requests import RequestError

if TYPE_CHECKING:
    from collections.abc import Callable

LASTING = 3600.0
"""[s] for which an act is remembered"""
MOST = 5000
LONGEST_KEY = 100


class _Before(NamedTuple):
    at: float
    digest: str
    answer: dict[str, Any]


class Replays:
    """Answers by the key of their request, for each visitor by itself."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        """Remember nothing yet."""
        self._clock = clock
        self._before: OrderedDict[tuple[str, str], _Before] = OrderedDict()

    def find(self, who: str, key: str, request: str) -> dict[str, Any] | None:
        """Return the answer that a request got before; None if it is new.

        Args:
            who: Session of the visitor.
            key: Of the request, chosen by the browser.
            request: All of it that counts.

        Raises:
            RequestError: The key is none, or was of another request.

        """
        if not 8 <= len(key) <= LONGEST_KEY or not key.isascii():
            msg = f'Idempotency-Key: give 8 to {LONGEST_KEY} characters, new for each act'
            raise RequestError(400, msg)
        self._forget()
        before = self._before.get((who, key))
        if before is None:
            return None
        if before.digest != _digest(request):
            raise RequestError(409, 'this Idempotency-Key was of another act: take a new one')
        return before.answer

    def keep(self, who: str, key: str, request: str, answer: dict[str, Any]) -> None:
        """Remember what a request was answered."""
        self._before[who, key] = _Before(self._clock(), _digest(request), answer)

    def _forget(self) -> None:
        oldest = self._clock() - LASTING
        while self._before:
            first = next(iter(self._before))
            if len(self._before) <= MOST and self._before[first].at >= oldest:
                return
            del self._before[first]


def _digest(request: str) -> str:
    return hashlib.sha256(request.encode('utf-8', 'replace')).hexdigest()
