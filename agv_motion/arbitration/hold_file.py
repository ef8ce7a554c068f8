"""What holds until a person releases it, kept over a restart: STOP, locks, dead-men that let go."""

from __future__ import annotations

import json
from math import isfinite
from typing import TYPE_CHECKING, Any

from agv_motion import saved_state
from agv_motion.arbitration.choice import FREE, HeldStop, Hold
from agv_motion.arbitration.source import TwistSource
from agv_motion.errors import ConfigurationError
from agv_motion.files import json_text

if TYPE_CHECKING:
    from pathlib import Path

VERSION = 1
LARGEST = 10_000
"""[bytes]"""
VALUES = 100
"""that it may have"""
LONGEST = 500
"""Characters of a reason that are kept."""


def save(path: str | Path, hold: Hold) -> None:
    """Write ``hold``; a power cut or a full disk leaves the old file or the new one, whole.

    Raises:
        OSError: The disk does not take it.

    """
    stop = hold.stop and {'reason': hold.stop.reason[:LONGEST], 'since': hold.stop.since}
    content = {
        'version': VERSION, 'stop': stop, 'locks': _names(hold.locks), 'lost': _names(hold.lost),
    }  # fmt: skip
    saved_state.save(path, json.dumps(content).encode())


def restore(path: str | Path, now: float) -> tuple[Hold, str]:
    """Return what was held, and what is worth telling, empty if nothing.

    A file that cannot be used is set aside, and STOP holds: nobody knows whether it did.

    Args:
        path: Of the file; there may be none.
        now: By the robot's clock [s].

    Raises:
        ConfigurationError: ``path`` is a folder, a symbolic link or a device.

    """
    found: list[Hold] = []
    complaint = saved_state.restore(path, lambda content: found.append(_read(content)), LARGEST)
    if complaint:
        reason = 'the file that tells whether STOP held could not be used'
        return Hold(HeldStop(reason, now)), f'state of the arbiter {complaint}'
    return found[0] if found else FREE, ''


def _names(sources: frozenset[TwistSource]) -> list[str]:
    return sorted(source.value for source in sources)


def _read(content: bytes) -> Hold:
    """Return what a file tells; raise a ValueError where anything is amiss."""
    values: Any = json_text.parse(content.decode(), 'the state of the arbiter', VALUES).value
    if not isinstance(values, dict) or values.get('version') != VERSION:
        msg = f'it is not of version {VERSION}'
        raise ConfigurationError(msg)
    try:
        stop, locks, lost = values['stop'], values['locks'], values['lost']
        held = None if stop is None else _stop(stop['reason'], stop['since'])
        return Hold(held, frozenset(map(TwistSource, locks)), frozenset(map(TwistSource, lost)))
    except (KeyError, TypeError) as error:
        msg = f'it lacks {error}, or has a value of another kind'
        raise ConfigurationError(msg) from error


def _stop(reason: Any, since: Any) -> HeldStop:
    number = isinstance(since, int | float) and not isinstance(since, bool)
    if not isinstance(reason, str) or not number or not isfinite(since):
        msg = f'STOP for {reason!r:.100} since {since!r:.100}: a text and a number are expected'
        raise ConfigurationError(msg)
    return HeldStop(reason, float(since))
