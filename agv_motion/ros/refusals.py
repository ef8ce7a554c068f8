"""What a node refuses, and how often: told at once, then ever more seldom, with a count.

A sender that is wrong is wrong at every message. However many come, and however different each is
worded, they fill no log.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

SOONEST, LATEST = 1.0, 60.0
"""[s] after which a reason is told again; the time doubles while it lasts."""
KINDS = 20
"""Reasons that are counted apart; what there is beyond that is told together."""

OTHERS = 'any other'
"""Name of what is told together."""

_NUMBER = re.compile(r'[\d.]+')


@dataclass
class _Kind:
    due: float
    pause: float = SOONEST
    untold: int = 0


class Refusals:
    """Decides what of the refusals of one node is worth a line in its log."""

    def __init__(self) -> None:
        """Know of none."""
        self._kinds: dict[str, _Kind] = {}

    def line(self, reason: str, now: float) -> str:
        """Count a refusal at ``now`` [s, steady]; return what to tell, empty if nothing."""
        name = _NUMBER.sub('#', reason)
        kind = self._kinds.get(name) or self._new(name, now)
        like = 'others' if kind is self._kinds.get(OTHERS) else 'more like it'
        if now < kind.due:
            kind.untold += 1
            return ''
        more = f' ({kind.untold} {like} since)' if kind.untold else ''
        kind.due, kind.untold = now + kind.pause, 0
        kind.pause = min(2.0 * kind.pause, LATEST)
        return f'{reason}{more}'

    def _new(self, name: str, now: float) -> _Kind:
        if len(self._kinds) >= KINDS:
            self._kinds = {n: k for n, k in self._kinds.items() if now < k.due + LATEST}
        if len(self._kinds) >= KINDS:
            name = OTHERS
        return self._kinds.setdefault(name, _Kind(now))
