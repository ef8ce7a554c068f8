"""What holds at the arbiter, kept on disk: a restart must not release a STOP."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.arbitration.choice import FREE, Hold
from agv_motion.arbitration.hold_file import restore, save
from agv_motion.saved_state import not_kept

if TYPE_CHECKING:
    from agv_motion.ros.port import Port


class HoldKeeper:
    """One file; none where its path is empty."""

    def __init__(self, port: Port, path: str) -> None:
        """Write nothing yet."""
        self.trouble = ''
        """Why STOP and locks would not outlast a restart; empty if they would, or need not"""
        self._port, self._path = port, path
        self._saved: Hold | None = None

    def before(self) -> Hold:
        """Return what held before the restart; where nobody can read that, a STOP."""
        if not self._path:
            return FREE
        hold, complaint = restore(self._path, self._port.seconds())
        if complaint:
            self._port.error(f'{complaint}: STOP holds; look at the robot, then release it')
        return hold

    def keep(self, hold: Hold) -> None:
        """Write what holds, where that has changed, or could not be written before."""
        if not self._path or hold == self._saved:
            return
        try:
            save(self._path, hold)
            self._saved, self.trouble = hold, ''
        except OSError as error:
            self.trouble = not_kept('STOP and locks over a restart', self._path, error)
            self._port.refuse(self.trouble)
