"""What the thread of a server asks of the thread of a node: a future here, an answer from there."""

from __future__ import annotations

import asyncio
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from agv_motion.errors import AgvMotionError, ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Callable


def promise() -> tuple[asyncio.Future[Any], Callable[[Any], None]]:
    """Return a future, and what ends it from another thread with a result or an error."""
    loop = asyncio.get_running_loop()
    future: asyncio.Future[Any] = loop.create_future()

    def settle(found: Any) -> None:
        if future.done():
            return
        if isinstance(found, Exception):
            future.set_exception(found)
        else:
            future.set_result(found)

    def answer(found: Any) -> None:
        with suppress(RuntimeError):  # the loop has ended meanwhile
            loop.call_soon_threadsafe(settle, found)

    return future, answer


def guarded(act: Callable[[], bool], answer: Callable[[Any], None]) -> Callable[[], bool]:
    """Return an act whose errors are told to who has asked."""

    def tried() -> bool:
        try:
            return act()
        except AgvMotionError as error:
            answer(error)
        except Exception as error:  # noqa: BLE001 - of rclpy, told to who has asked
            answer(ConfigurationError(f'{type(error).__name__}: {error}'))
        return True

    return tried
