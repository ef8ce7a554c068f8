"""Parameters of node `bag_recorder`."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path
from typing import Annotated

from agv_motion.bag.events.event_parameters import EventParameters
from agv_motion.bag.recording.storage_parameters import StorageParameters
from agv_motion.parameters import Spec


@dataclass(frozen=True)
class BagRecorderParameters(EventParameters):
    """What to record, and where to."""

    output: Annotated[
        str, Spec('folder of the new bag; empty: bag_ and the time, in the working directory')
    ] = ''
    all: Annotated[bool, Spec('record every topic')] = False
    topics: Annotated[tuple[str, ...], Spec('record these')] = ()
    regex: Annotated[str, Spec('record topics in whose name this is found')] = ''
    exclude_topics: Annotated[tuple[str, ...], Spec('never record these')] = ()
    exclude_regex: Annotated[str, Spec('never record topics in whose name this is found')] = ''
    include_hidden_topics: Annotated[bool, Spec('hidden topics as well')] = False
    start_paused: Annotated[bool, Spec('wait for ~/resume')] = False
    polling_interval: Annotated[float, Spec('between looks for new topics', 's', (0.01, 60))] = 0.1
    storage: StorageParameters = field(default_factory=StorageParameters)

    def __post_init__(self) -> None:
        """Check every row, and each trigger."""
        super().__post_init__()

    def ring(self) -> StorageParameters:
        """Return how the recording lies on the disk: in short files if it is for events alone."""
        if not self.only_events or self.storage.max_bag_duration:
            return self.storage
        return replace(self.storage, max_bag_duration=min(max(self.before / 4.0, 1.0), 60.0))

    def folder(self) -> Path:
        """Return where the bag goes."""
        return Path(self.output or datetime.now().astimezone().strftime('bag_%Y_%m_%d-%H_%M_%S'))
