"""How a node is, in a level, words and numbers."""

from __future__ import annotations

from typing import NamedTuple

from diagnostic_msgs.msg import DiagnosticStatus

OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR


class Diagnosis(NamedTuple):
    """How a node is, in words and numbers, for ``/diagnostics``."""

    level: bytes
    message: str
    values: dict[str, str]
    stamp: int | None = None
    """when it was so [ns]; None: now, by the node's clock"""

    def worsened(self, message: str) -> Diagnosis:
        """Return this as a warning of what is wrong, where nothing was."""
        return self._replace(level=WARN, message=message) if self.level == OK else self
