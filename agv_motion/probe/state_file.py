"""What the probes have learnt, kept over a restart: a night and a week are long to learn again."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.probe.probe import Probe

VERSION = 1


def save(path: str | Path, probes: Sequence[Probe]) -> None:
    """Write the state of all probes; a power cut leaves the old file or the new one, whole."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    new = path.with_name(path.name + '.new')
    with new.open('w', encoding='utf-8') as file:
        json.dump({'version': VERSION, 'probes': [probe.state() for probe in probes]}, file)
        file.flush()
        os.fsync(file.fileno())
    new.replace(path)


def restore(path: str | Path, probes: Sequence[Probe]) -> str:
    """Give the probes back what they knew; return what was wrong, empty if nothing.

    A file that cannot be used is set aside under the name ``*.unusable``, never overwritten.
    """
    path = Path(path)
    if not path.exists():
        return ''
    try:
        states = _read(path, len(probes))
        for probe, state in zip(probes, states, strict=True):
            probe.restore(state)
    except (OSError, ValueError) as error:  # ConfigurationError and JSON errors are ValueErrors
        aside = path.with_name(path.name + '.unusable')
        path.replace(aside)
        return f'probe state {path} was set aside as {aside.name}: {error}'
    return ''


def _read(path: Path, count: int) -> list[dict[str, object]]:
    content = json.loads(path.read_text(encoding='utf-8'))
    if not isinstance(content, dict) or content.get('version') != VERSION:
        msg = f'it is not a probe state of version {VERSION}'
        raise ConfigurationError(msg)
    states = content.get('probes')
    if not isinstance(states, list) or len(states) != count:
        msg = f'it does not hold the state of {count} probes'
        raise ConfigurationError(msg)
    return states
