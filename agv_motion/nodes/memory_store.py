"""What `motion_generator` does with its memory of places: show it as maps, keep it on disk."""

from __future__ import annotations

from array import array
from concurrent import futures
from typing import TYPE_CHECKING, Any

import numpy as np
from nav_msgs.msg import OccupancyGrid

from agv_motion.motion.behavior.memory_file import restore, save
from agv_motion.ros.qos import LATCHED
from agv_motion.saved_state import not_kept, set_aside

if TYPE_CHECKING:
    from agv_motion.motion.behavior.cells import Map, Mask
    from agv_motion.motion.behavior.memory import Grid, Memory
    from agv_motion.nodes.motion_parameters import MotionGeneratorParameters
    from agv_motion.ros.port import Port

SAVE_PERIOD = 15.0
"""[s] A power cut loses this much, and what the disk was still writing: less than 30 s."""

CHECK_PERIOD = 0.5
"""[s] within which a disk that does not take the memory is told."""

PATIENCE = 5.0
"""[s] How long a stopping node waits for the disk."""


class MemoryStore:
    """Publishes `memory/sap_flow` and `memory/last_visit`, and saves in a thread of its own.

    The disk may take its time: the node only copies the maps.
    """

    def __init__(self, port: Port, memory: Memory, given: MotionGeneratorParameters) -> None:
        """Restore the memory and open its topics.

        Args:
            port: Of the node that is being configured.
            memory: To show and to keep.
            given: Where to keep it, and how to show it.

        """
        self._port, self._memory = port, memory
        self._file, self._span = given.memory_file, given.last_visit_span
        self._frame = given.map_frame
        self._message = self._empty_map(memory)
        self._flow = port.publisher(OccupancyGrid, 'memory/sap_flow', LATCHED)
        self._visit = port.publisher(OccupancyGrid, 'memory/last_visit', LATCHED)
        self._shown = False
        port.every(given.map_period, self.publish, steady=True)
        self._writer: futures.ThreadPoolExecutor | None = None
        self._saved: float | None = None
        self._writing: futures.Future[None] | None = None
        self._trouble = ''
        if self._file:
            complaint = restore(self._file, memory)
            if complaint:
                port.warning(complaint)
            self._writer = futures.ThreadPoolExecutor(1, 'memory')
            port.every(SAVE_PERIOD, self.save, steady=True)
            port.every(CHECK_PERIOD, self._check, steady=True)

    def begin(self) -> None:
        """Show both maps; and save at once, so that a full disk is told before it matters."""
        self._shown = False
        self.publish()
        self.save()

    def move_to(self, memory: Memory) -> None:
        """Show and keep the memory of another zone; that of the last is set aside beside it."""
        if self._writer is not None:
            self._check()
            grids = self._memory.grid(), memory.grid()
            self._writing = self._writer.submit(_replace, self._file, *grids)
            self._saved = memory.newest
        self._memory, self._message = memory, self._empty_map(memory)
        self.publish()

    def publish(self) -> None:
        """Show both maps: 0 to 100, unknown -1."""
        memory, now = self._memory, self._port.seconds()
        if now <= 0.0:
            return  # no /clock yet: a map of 1970 would be latched
        self._shown = True
        self._publish(self._flow, 100.0 * memory.remembered(now), memory.felt)
        hours = (now - memory.visited_at) / 3600.0
        self._publish(self._visit, 100.0 * hours / self._span, memory.visited)

    def publish_first(self) -> None:
        """Show both maps once there is a time to stamp them with."""
        if not self._shown:
            self.publish()

    def save(self) -> None:
        """Let the thread write what is remembered now, if that is new and the last is written."""
        self._check()
        if self._memory.newest == self._saved or self._writer is None:
            return
        if self._writing is not None:
            self._port.refuse(f'the disk is slow: {self._file} is still being written')
            return
        self._saved = self._memory.newest
        self._writing = self._writer.submit(save, self._file, self._memory.grid())

    def save_at_last(self) -> None:
        """Write what is remembered and wait for the disk."""
        if self._writer is not None:
            self._check(PATIENCE)
            self._writing = self._writer.submit(save, self._file, self._memory.grid())
            self._check(PATIENCE)

    def _check(self, patience: float = 0.0) -> None:
        """Tell what came of the last save, waiting for it at most ``patience`` [s]."""
        if self._writing is None or (patience == 0.0 and not self._writing.done()):
            return
        try:
            self._writing.result(patience)
            self._trouble = ''
        except (OSError, futures.TimeoutError) as error:
            self._trouble = not_kept('the memory of places', self._file, error)
            self._saved = None
            self._port.refuse(self._trouble)
        self._writing = None

    def report(self) -> dict[str, str]:
        """Return how much is remembered, for the diagnostics, and whether the disk keeps it."""
        visited, felt = self._memory.coverage()
        shares = {'visited': f'{100 * visited:.1f} %', 'felt': f'{100 * felt:.1f} %'}
        return shares | ({'memory_file': self._trouble} if self._trouble else {})

    def _empty_map(self, memory: Memory) -> OccupancyGrid:
        message = OccupancyGrid()
        message.header.frame_id = self._frame
        message.info.map_load_time = message.header.stamp
        message.info.resolution = memory.cells.size
        message.info.height, message.info.width = memory.flow.shape
        corner = message.info.origin.position
        corner.x, corner.y = memory.cells.corner
        return message

    def _publish(self, publisher: Any, values: Map, known: Mask) -> None:
        message = self._message
        self._port.stamp(message)
        cells = np.full(values.shape, -1, np.int8)
        cells[known] = np.clip(np.rint(values[known]), 0, 100).astype(np.int8)
        message.data = array('b', cells.tobytes())
        publisher.publish(message)


def _replace(file: str, old: Grid, new: Grid) -> None:
    """Keep what was known of a zone beside what is of the other, as a start in that would.

    Raises:
        OSError: The disk does not take it.

    """
    save(file, old)
    set_aside(file, '.other_zone')
    save(file, new)
