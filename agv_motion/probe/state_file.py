"""What the probes have learnt, kept over a restart: a night and a week are long to learn again."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from agv_motion import saved_state
from agv_motion.errors import ConfigurationError
from agv_motion.files import json_text

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from agv_motion.probe.probe import Probe

VERSION = 1
VALUES = 500_000
"""that it may have: the longest window in the shortest bins has fewer"""


def save(path: str | Path, probes: Sequence[Probe]) -> None:
    """Write the state of all probes; a power cut leaves the old file or the new one, whole.

    Raises:
        OSError: The disk does not take it.

    """
    content = {'version': VERSION, 'probes': [probe.state() for probe in probes]}
    saved_state.save(path, json.dumps(content).encode())


def restore(path: str | Path, probes: Sequence[Probe]) -> str:
    """Give the probes back what they knew; return what was wrong, empty if nothing.

    A file that cannot be used is set aside, and no probe takes up any of it.

    Raises:
        ConfigurationError: ``path`` is a folder, a symbolic link or a device.

    """

    def take(content: bytes) -> None:
        states = _states(content, len(probes))
        before = [probe.state() for probe in probes]
        try:
            for probe, state in zip(probes, states, strict=True):
                probe.restore(state)
        except ConfigurationError:
            for probe, state in zip(probes, before, strict=True):
                probe.restore(state)
            raise

    complaint = saved_state.restore(path, take)
    return f'probe state {complaint}' if complaint else ''


def _states(content: bytes, count: int) -> list[dict[str, object]]:
    values = json_text.parse(content.decode(), 'the probe state', VALUES).value
    if not isinstance(values, dict) or values.get('version') != VERSION:
        msg = f'it is not a probe state of version {VERSION}'
        raise ConfigurationError(msg)
    states = values.get('probes')
    if not isinstance(states, list) or len(states) != count:
        msg = f'it does not hold the state of {count} probes'
        raise ConfigurationError(msg)
    return states
