"""How many threads work on a bag."""

from __future__ import annotations

import os

_MOST = 4
"""what they write and read is then what bounds them"""


def threads() -> int:
    """Return how many threads this machine has use for."""
    return min(os.cpu_count() or 1, _MOST)
