"""What the floor under the platform allows."""

from __future__ import annotations

from typing import NamedTuple


class FloorRules(NamedTuple):
    """What the place of the platform allows."""

    may_turn: bool = True
    top_speed: float = 1.0
    """largest v"""
