"""`agv sequence --actions`: every key of every action, from the rows of its dataclass."""

from __future__ import annotations

from dataclasses import MISSING, fields
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.parameters import rows
from agv_motion.sequence.sequence_file import ACTIONS

if TYPE_CHECKING:
    from collections.abc import Iterator


class Key(NamedTuple):
    """One key, as a person reads it."""

    action: str
    key: str
    default: str
    allowed: str
    meaning: str


ROUTE = (
    Key('follow_route', 'file', '', '', 'CSV or YAML, looked for beside the sequence; or'),
    Key('', 'waypoints', '', '', '[[x, y], ...] [m]'),
    Key('', 'laps', '1', '0 or more', 'how often to go round; 0: without end'),
)
OPTIONS = (
    Key('beside each', 'timeout', '60.0', 'above 0', 'longest time it may move [s]'),
    Key('', 'on_failure', 'stop', '', 'stop, skip, retry N, or retry N then skip'),
    Key('', 'name', '', '', 'what to call it in messages'),
)


def keys() -> Iterator[Key]:
    """Yield the keys of all actions, and then what may stand beside each."""
    for name, kind in ACTIONS.items():
        if name == 'follow_route':
            yield from ROUTE
            continue
        defaults = {field.name: field.default for field in fields(kind)}
        for i, (key, _, spec) in enumerate(rows(kind)):
            default = defaults[key]
            unit = f' [{spec.unit}]' if spec.unit not in {'', '1'} else ''
            yield Key(
                '' if i else name,
                key,
                'required' if default is MISSING else '' if default is None else str(default),
                '{:g} to {:g}'.format(*spec.between) if spec.between else 'true, false',
                spec.description + unit,
            )
    yield from OPTIONS
