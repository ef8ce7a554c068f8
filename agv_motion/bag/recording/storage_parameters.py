"""How a recording is laid out on the disk: compression, files, and what happens when it fills."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Annotated

from agv_motion.parameters import Spec, check

MEGABYTE = 1e6


class FullDisk(Enum):
    """What a recording does when the disk is full."""

    STOP = 'stop'
    """It ends"""
    DROP_OLDEST = 'drop_oldest'
    """It deletes its oldest file and goes on"""


@dataclass(frozen=True)
class StorageParameters:
    """Files of a recording, how safe they are, and how much of the disk they may take."""

    compression: Annotated[str, Spec('of the chunks', choices=('zstd', 'lz4', 'none'))] = 'zstd'
    flush_period: Annotated[
        float, Spec('a crash loses at most what came within this time', 's', (0.05, 60.0))
    ] = 0.5
    sync: Annotated[
        bool,
        Spec('wait for the disk at each flush, so that a power cut loses no more than a crash'),
    ] = True
    max_bag_size: Annotated[
        float, Spec('go on in a new file at this size; 0: one file', 'MB', (0.0, 1e9))
    ] = 0.0
    max_bag_duration: Annotated[
        float, Spec('go on in a new file after this time; 0: one file', 's', (0.0, 1e9))
    ] = 0.0
    keep_files: Annotated[
        int, Spec('number of finished files to keep, the newest; 0: all', '', (0, 1_000_000))
    ] = 0
    keep_free: Annotated[float, Spec('how much of the disk to leave free', 'MB', (0.0, 1e9))] = (
        100.0
    )
    when_full: Annotated[
        str,
        Spec(
            'at that floor stop, or delete the oldest file',
            choices=tuple(each.value for each in FullDisk),
        ),
    ] = FullDisk.STOP.value
    cache: Annotated[
        float, Spec('messages that wait for a slow disk; beyond, they are lost', 'MB', (1.0, 1e6))
    ] = 256.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)
