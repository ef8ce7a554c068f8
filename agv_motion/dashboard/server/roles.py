"""Who may do what."""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple


class Role(IntEnum):
    """Each may do what those before it may."""

    PUBLIC = 0
    """sees where the robots are"""
    VIEWER = 1
    """sees everything"""
    OPERATOR = 2
    """stops, pauses, sends and drives robots"""
    EXPERT = 3
    """changes parameters, zone and hours"""

    @property
    def word(self) -> str:
        """The role in a word, as the page and the command line have it."""
        return self.name.lower()


ROLES = {role.word: role for role in Role}


class Visitor(NamedTuple):
    """Whoever is at a door."""

    name: str
    """of the user; empty: nobody has logged in"""
    role: Role
    csrf: str
    """token that its acts must bear; empty: it cannot act"""
