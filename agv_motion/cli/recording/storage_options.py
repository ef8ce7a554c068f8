"""How a recording lies on the disk: options of `agv record`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

Output = Annotated[
    Path | None, typer.Option('-o', '--output', help='Folder of the bag; must not exist.')
]
StartPaused = Annotated[bool, typer.Option('--start-paused', help='Wait for the service ~/resume.')]
Compression = Annotated[str, typer.Option(help='zstd, lz4 or none.')]
MaxBagSize = Annotated[
    float, typer.Option('-b', '--max-bag-size', help='Bytes before a new file; 0: never.')
]
MaxBagDuration = Annotated[
    float, typer.Option('-d', '--max-bag-duration', help='Seconds before a new file; 0: never.')
]
KeepFiles = Annotated[
    int, typer.Option(help='Keep only the newest so many finished files; 0: all.')
]
KeepFree = Annotated[float, typer.Option(help='Megabytes of the disk to leave free.')]
WhenFull = Annotated[
    str, typer.Option(help='At that floor: stop, or drop_oldest to delete the oldest file.')
]
MaxCacheSize = Annotated[float, typer.Option(help='Bytes that may wait for a slow disk.')]
Sync = Annotated[
    bool, typer.Option(help='Survive a power cut as well as a crash, but for half a second.')
]
