"""What may have been meant by a name that is not there."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence


def meant(name: str, choices: Sequence[str]) -> str:
    """Return a question for what may have been meant, or nothing."""
    close = get_close_matches(name, choices)
    return f"; did you mean '{close[0]}'?" if close else ''
