"""The memory of places on disk: written whole or not at all, checked before it is believed."""

from __future__ import annotations

import os
import zipfile
import zlib
from contextlib import suppress
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from agv_motion.errors import ConfigurationError
from agv_motion.motion.memory import NEVER, Grid

if TYPE_CHECKING:
    from agv_motion.motion.memory import Memory

VERSION = 1
UNREADABLE = (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile, zlib.error)
"""What numpy raises on a file that is not one of its own, cut short, or damaged (CRC)."""


def save(path: str | Path, grid: Grid) -> None:
    """Write ``grid``; a power cut leaves the old file or the new one, whole.

    Raises:
        OSError: The disk does not take it.

    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    new = path.with_name(path.name + '.new')
    with new.open('wb') as file:
        np.savez_compressed(file, version=VERSION, **grid._asdict())
        file.flush()
        os.fsync(file.fileno())
    new.replace(path)
    with suppress(OSError):  # some file systems have no folders to synchronise
        folder = os.open(path.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)


def restore(path: str | Path, memory: Memory) -> str:
    """Give ``memory`` back what it knew; return what is worth telling, empty if nothing.

    A file that cannot be used is set aside as ``*.unusable``; that of another zone or another size
    of cells is carried over as far as it fits, and kept as ``*.other_zone``.

    Raises:
        ConfigurationError: ``path`` is a folder.

    """
    path = Path(path)
    if path.is_dir():
        msg = f"memory_file = '{path}' is a folder: give a file in it"
        raise ConfigurationError(msg)
    if not path.exists():
        return ''
    try:
        grid = _read(path)
    except UNREADABLE as error:
        return f'memory {path} cannot be used: {error}; {_set_aside(path, ".unusable")}'
    if memory.recall(grid):
        return ''
    cells = int(memory.visited.sum())
    return (
        f'memory {path} belongs to another zone or size of cells: {cells} of '
        f'{int(memory.walkable.sum())} cells carried over; {_set_aside(path, ".other_zone")}'
    )


def _set_aside(path: Path, suffix: str) -> str:
    aside = path.with_name(path.name + suffix)
    try:
        path.replace(aside)
    except OSError as error:
        return f'it could not be set aside ({error})'
    return f'set aside as {aside.name}'


def _read(path: Path) -> Grid:
    """Return the grid of a file.

    Raises:
        ConfigurationError: It is no memory, or holds values that no memory can.

    """
    data = BytesIO(path.read_bytes())
    if not zipfile.is_zipfile(data):
        msg = 'it is no archive of numpy, or its end is missing'
        raise ConfigurationError(msg)
    with np.load(data, allow_pickle=False) as content:
        if 'version' not in content or int(content['version']) != VERSION:
            msg = f'it is no memory of version {VERSION}'
            raise ConfigurationError(msg)
        west, south, cell = (float(content[name]) for name in ('west', 'south', 'cell'))
        flow, felt_at, visited_at = (
            content[name].astype(np.float64) for name in ('flow', 'felt_at', 'visited_at')
        )
        grid = Grid(west, south, cell, flow, felt_at, visited_at, str(content['zone']))
    shapes = {grid.flow.shape, grid.felt_at.shape, grid.visited_at.shape}
    if len(shapes) != 1 or grid.flow.ndim != 2 or grid.flow.size == 0:
        msg = f'its maps have the shapes {sorted(shapes)}'
        raise ConfigurationError(msg)
    felt = np.isfinite(grid.flow)
    if not np.isfinite((grid.west, grid.south)).all() or not 0.0 < grid.cell < np.inf:
        msg = f'it lies at ({grid.west}, {grid.south}) in cells of {grid.cell} m'
        raise ConfigurationError(msg)
    if ((grid.flow[felt] < 0.0) | (grid.flow[felt] > 1.0)).any():
        msg = 'it holds sap flow outside [0, 1]'
        raise ConfigurationError(msg)
    if (felt != np.isfinite(grid.felt_at)).any() or not _times(grid.visited_at):
        msg = 'it holds times that are none'
        raise ConfigurationError(msg)
    return grid


def _times(values: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> bool:
    return bool((np.isfinite(values) | (values == NEVER)).all())
