"""What a file says that cannot be: every finding names the file and the byte."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from pathlib import Path

CLOSED = '{} was closed: read inside the with block of its reader, or open the bag again'
"""What is wrong when somebody reads on."""


class DamagedBagError(SourceError):
    """A bag is damaged, or hostile, at a byte of a file."""

    def __init__(
        self,
        path: Path | str,
        offset: int,
        finding: str,
        remedy: str = '',
        *,
        harmless: bool = False,
    ) -> None:
        """Keep where and what.

        Args:
            path: The file.
            offset: [bytes] from its beginning.
            finding: What stands there, and what was expected.
            remedy: What a person can do; by default, ``agv bag recover``.
            harmless: Whether everything can be read all the same.

        """
        self.path, self.offset, self.finding, self.harmless = path, offset, finding, harmless
        remedy = remedy or 'agv bag recover saves what can be read'
        super().__init__(f'{path}, byte {offset}: {finding}; {remedy}')
