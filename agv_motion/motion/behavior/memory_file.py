"""The memory of places on disk: an archive of numpy, checked before it is believed."""

from __future__ import annotations

import struct
import zipfile
import zlib
from io import BytesIO
from math import prod
from typing import TYPE_CHECKING

import numpy as np

from agv_motion import saved_state
from agv_motion.errors import ConfigurationError
from agv_motion.motion.behavior.cells import LARGEST
from agv_motion.motion.behavior.memory import NEVER, Grid

if TYPE_CHECKING:
    from pathlib import Path
    from typing import Any

    from numpy.typing import NDArray

    from agv_motion.motion.behavior.memory import Memory

VERSION = 1
NAMES = ('version', *Grid._fields)

HEADER = 16_384
"""[bytes] that a member of the archive may have beside its values."""

COMPRESSIONS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)

DAMAGE = (
    zipfile.BadZipFile, zipfile.LargeZipFile, zlib.error, struct.error, EOFError, KeyError,
    IndexError, NotImplementedError, RuntimeError, SyntaxError, TypeError, OverflowError,
)  # fmt: skip
"""What the readers of archives and of numpy's headers raise on damage, beside ValueErrors."""


def save(path: str | Path, grid: Grid) -> None:
    """Write ``grid``; a power cut or a full disk leaves the old file or the new one, whole.

    Raises:
        OSError: The disk does not take it.

    """
    content = BytesIO()
    np.savez_compressed(content, version=VERSION, **grid._asdict())
    saved_state.save(path, content.getvalue())


def restore(path: str | Path, memory: Memory) -> str:
    """Give ``memory`` back what it knew; return what is worth telling, empty if nothing.

    A file that cannot be used is set aside as ``*.unusable``; that of another zone or another size
    of cells is carried over as far as it fits, and kept as ``*.other_zone``.

    Raises:
        ConfigurationError: ``path`` is a folder, a symbolic link or a device.

    """
    same = True

    def take(content: bytes) -> None:
        nonlocal same
        same = memory.recall(grid_of(content))

    complaint = saved_state.restore(path, take)
    if complaint:
        return f'memory {complaint}'
    if same:
        return ''
    cells = int(memory.visited.sum())
    return (
        f'memory {path} belongs to another zone or size of cells: {cells} of '
        f'{int(memory.cells.walkable.sum())} cells carried over; '
        f'{saved_state.set_aside(path, ".other_zone")}'
    )


def grid_of(content: bytes) -> Grid:
    """Return the grid of the content of a file.

    Raises:
        ConfigurationError: It is no memory, or holds values that no memory can.

    """
    if not content.startswith(b'PK'):
        msg = 'it is no archive of numpy'
        raise ConfigurationError(msg)
    try:
        with zipfile.ZipFile(BytesIO(content)) as archive:
            values = {name: _array(archive, name) for name in NAMES}
        if int(values['version']) != VERSION:
            msg = f'it is no memory of version {VERSION}'
            raise ConfigurationError(msg)
        west, south, cell = (float(values[name]) for name in ('west', 'south', 'cell'))
        flow, felt_at, visited_at = (
            values[name].astype(np.float64) for name in ('flow', 'felt_at', 'visited_at')
        )
        grid = Grid(west, south, cell, flow, felt_at, visited_at, str(values['zone']))
    except DAMAGE as error:
        msg = f'it is no memory of places, or damaged: {error!r:.120}'
        raise ConfigurationError(msg) from error
    _check(grid)
    return grid


def _array(archive: zipfile.ZipFile, name: str) -> NDArray[Any]:
    """Return one member of an archive; its size is checked before anything is allocated.

    Raises:
        ConfigurationError: It is larger than a memory can be, or not as large as it says.

    """
    member = archive.getinfo(f'{name}.npy')
    if member.file_size > 8 * LARGEST + HEADER or member.compress_type not in COMPRESSIONS:
        msg = f"'{name}' would unpack to {member.file_size} bytes: no memory does"
        raise ConfigurationError(msg)
    with archive.open(member) as file:
        data = BytesIO(file.read(member.file_size))  # with a size: what more there is stays packed
    version = np.lib.format.read_magic(data)
    if version != (1, 0):
        msg = f"'{name}' is an array of format {version}, expected (1, 0)"
        raise ConfigurationError(msg)
    shape, fortran, kind = np.lib.format.read_array_header_1_0(data)
    left = data.getbuffer()[data.tell() :]
    if kind.kind not in 'fiuU' or fortran or prod(shape) * kind.itemsize != len(left):
        msg = f"'{name}' is said to hold {shape!s:.60} of {kind!s:.20} in {len(left)} bytes"
        raise ConfigurationError(msg)
    return np.frombuffer(left, kind).reshape(shape)


def _check(grid: Grid) -> None:
    """Raise a ConfigurationError where a grid holds what no memory can."""
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


def _times(values: NDArray[np.float64]) -> bool:
    return bool((np.isfinite(values) | (values == NEVER)).all())
