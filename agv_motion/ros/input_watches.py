"""Inputs without which a node does not act: which of them is lost, told by its name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.ros.input_watch import Freshness, InputWatch
from agv_motion.watchdog import Silence

if TYPE_CHECKING:
    from agv_motion.ros.port import Port


class InputWatches:
    """A watch for each input."""

    def __init__(self, port: Port, limits: Freshness, names: tuple[str, ...]) -> None:
        """Start with inputs that have never come; ``limits`` hold for each."""
        self._port = port
        self._watches = {name: InputWatch(port, name, limits) for name in names}
        self.lost = names[0]
        """the first that is lost, by its name; empty: none is"""

    def __getitem__(self, name: str) -> InputWatch:
        """Return the watch of an input."""
        return self._watches[name]

    def wait_for(self, name: str) -> None:
        """Take an input for lost until news of it has come."""
        self.lost = name

    def note(self, name: str) -> None:
        """Note news of an input; nobody waits for the next look where it was the last one lost."""
        self._watches[name].note()
        if self.lost:
            pairs = self._watches.items()
            self.lost = next((n for n, watch in pairs if watch.silence() is Silence.LOST), '')

    def look(self) -> bool:
        """Judge all inputs and log what has changed; return whether to stop at once.

        That is when one is lost that was not before, or where a clock that stands ticks no more.
        """
        before, self.lost = self.lost, ''
        for name, watch in self._watches.items():
            if watch.tell() is Silence.LOST and not self.lost:
                self.lost = name
        return bool(self.lost) and (bool(self._port.clock.fault) or not before)
