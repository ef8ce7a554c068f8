"""What a recorder takes for an event, and how much of the recording belongs to it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from agv_motion.bag.columns.condition import Condition, condition
from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check

MOST_TRIGGERS = 100
LONGEST_BEFORE = 86400.0
"""[s] that a recorder keeps before an event, at most"""
FOLDER = 'events'


@dataclass(frozen=True)
class EventParameters:
    """What makes an event, and what is kept of the time around it."""

    trigger: Annotated[
        tuple[str, ...],
        Spec("events: '/state ~ stopped', '/turrets/residual > 0.02'; as agv bag cut --around"),
    ] = ()
    before: Annotated[
        float, Spec('how long before it an event begins', 's', (0.0, LONGEST_BEFORE))
    ] = 120.0
    after: Annotated[float, Spec('... and how long after it one ends', 's', (0.0, 86400.0))] = 60.0
    longest_event: Annotated[
        float, Spec('events on end are one bag for this long after the first', 's', (1.0, 86400.0))
    ] = 600.0
    events: Annotated[str, Spec('folder of the bags of events; empty: events, beside output')] = ''
    only_events: Annotated[
        bool, Spec('keep no more on the disk than an event may need, and events alone at the end')
    ] = False

    def __post_init__(self) -> None:
        """Check every row, and each trigger."""
        check(self)
        self.conditions()

    def conditions(self) -> tuple[Condition, ...]:
        """Return the triggers.

        Raises:
            ConfigurationError: One is no condition, or there are too many.

        """
        if len(self.trigger) > MOST_TRIGGERS:
            msg = f'trigger has {len(self.trigger)} conditions: expected at most {MOST_TRIGGERS}'
            raise ConfigurationError(msg)
        try:
            return tuple(map(condition, self.trigger))
        except ConfigurationError as error:
            msg = f'trigger: {error}'
            raise ConfigurationError(msg) from None

    def events_folder(self, bag: Path) -> Path:
        """Return where the events of a bag go."""
        return Path(self.events) if self.events else bag.absolute().parent / FOLDER
