"""What a reader of bags is asked for: which topics, from when to when."""

from __future__ import annotations

from operator import index
from typing import TYPE_CHECKING, SupportsIndex

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Iterable

FOREVER = 2**64
"""[ns] later than any log time"""


def listed(names: str | Iterable[str]) -> list[str]:
    """Return names as a list; one name alone is a list of one."""
    return [names] if isinstance(names, str) else list(names)


def whole(name: str, time: object) -> int:
    """Return a time that somebody gave [ns].

    Raises:
        ConfigurationError: It is no whole number.

    """
    if isinstance(time, SupportsIndex) and not isinstance(time, bool):
        return index(time)
    msg = (
        f'{name} = {time!r}: give whole nanoseconds since 1970 (an int), such as '
        'bag.start + 5 * 10**9, five seconds after the beginning'
    )
    raise ConfigurationError(msg)


def span_of(start: int | None, stop: int | None) -> tuple[int, int]:
    """Return the first log time, and that before which to stop [ns]; None means no limit.

    Raises:
        ConfigurationError: One is no whole number.

    """
    begin = 0 if start is None else max(whole('start', start), 0)
    return begin, FOREVER if stop is None else max(whole('stop', stop), 0)
