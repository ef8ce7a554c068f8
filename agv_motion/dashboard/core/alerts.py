"""Alerts: what is wrong with the robots, raised once, cleared once, and acknowledged by a person.

Fed with chains of reasons (`why`). Only first causes count: a probe that is off makes one alert,
not one for each part of the robot that stands because of it. What trembles raises nothing and
clears nothing: a fault must last before it is told, and its absence must last before it is over.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

OK, WARN, ERROR, STALE = 'OK', 'WARN', 'ERROR', 'STALE'

RAISE_AFTER = {WARN: 30.0, STALE: 5.0, ERROR: 1.0}
"""[s] for which a link must have been so bad; a tree waits for another for a while every day."""

CLEAR_AFTER = 5.0
"""[s] for which it must have been well again"""

SILENT_AFTER = 5.0
"""[s] without a chain after which that itself is an alert"""

MOST = 1000
"""alerts that are kept; of those that are over the oldest go first"""

SILENCE = 'silence'
"""Name of the link that stands for a robot which says nothing"""


class AlertLink(Protocol):
    """What of a link of the chain of reasons counts."""

    @property
    def name(self) -> str:
        """Of the part of the robot."""

    @property
    def level(self) -> str:
        """OK, WARN, ERROR or STALE."""

    @property
    def sentence(self) -> str:
        """How it is, in words."""

    @property
    def because(self) -> str:
        """Name of the link that it goes back to; empty: it is a first cause."""


class PlainLink(NamedTuple):
    """A link as values alone."""

    name: str
    level: str
    sentence: str
    because: str = ''


class Alert(NamedTuple):
    """One alert; times in seconds since 1970."""

    id: str
    robot: str
    name: str
    """of the link"""
    level: str
    """the worst it was"""
    sentence: str
    """as it was told when it was raised, or became worse"""
    raised: float
    cleared: float | None = None
    acknowledged: float | None = None
    by: str = ''
    """who acknowledged it"""


@dataclass
class _Trouble:
    """A link that is not well, or was not a moment ago."""

    since: dict[str, float] = field(default_factory=dict)
    """by level: since when it has been at least so bad"""
    well_since: float | None = None
    id: str = ''
    """of its alert; empty while none is raised"""


ORDER = (OK, WARN, STALE, ERROR)


class AlertBook:
    """All alerts of all robots."""

    def __init__(
        self, raise_after: Mapping[str, float] | None = None, clear_after: float = CLEAR_AFTER
    ) -> None:
        """Know of none.

        Args:
            raise_after: [s] by level; None: `RAISE_AFTER`.
            clear_after: [s].

        """
        self._raise_after = dict(raise_after or RAISE_AFTER)
        self._clear_after = clear_after
        self._alerts: dict[str, Alert] = {}
        self._over: deque[str] = deque()
        self._troubles: dict[tuple[str, str], _Trouble] = {}
        self._heard: dict[str, float] = {}

    def alerts(self) -> list[Alert]:
        """Return all alerts, the latest first."""
        return sorted(self._alerts.values(), key=lambda alert: -alert.raised)

    def standing(self) -> list[Alert]:
        """Return those that are not cleared, the worst first."""
        found = [alert for alert in self.alerts() if alert.cleared is None]
        return sorted(found, key=lambda alert: -ORDER.index(alert.level))

    def restore(self, alerts: Iterable[Alert]) -> None:
        """Take up alerts of an earlier run; those that still stand are cleared if all is well."""
        for alert in alerts:
            self._alerts[alert.id] = alert
            if alert.cleared is None:
                trouble = self._troubles.setdefault((alert.robot, alert.name), _Trouble())
                trouble.id = alert.id
            else:
                self._over.append(alert.id)

    def update(self, robot: str, links: Iterable[AlertLink], now: float) -> list[Alert]:
        """Take up the chain of a robot; return the alerts that are new, worse or over.

        Args:
            robot: Its name.
            links: Of its chain.
            now: [s since 1970]; may leap, as clocks do.

        """
        self._heard[robot] = now
        found = {link.name: link for link in links}
        causes = {
            name: link for name, link in found.items()
            if link.level in ORDER[1:] and not (link.because and _is_bad(found.get(link.because)))
        }  # fmt: skip
        known = {name for whose, name in self._troubles if whose == robot}
        changed = [
            self._judge(robot, name, causes.get(name), now) for name in sorted(known | {*causes})
        ]
        return [alert for alert in changed if alert is not None]

    def look(self, now: float) -> list[Alert]:
        """Return the alerts of robots that have fallen silent, or speak again."""
        changed = []
        for robot, heard in self._heard.items():
            silent = abs(now - heard)
            link = None
            if silent >= SILENT_AFTER:
                link = PlainLink(SILENCE, ERROR, f'{robot} has said nothing for {silent:.0f} s')
            elif (robot, SILENCE) not in self._troubles:
                continue
            changed.append(self._judge(robot, SILENCE, link, now))
        return [alert for alert in changed if alert is not None]

    def acknowledge(self, alert_id: str, by: str, now: float) -> Alert | None:
        """Note who has seen an alert; the first counts. None if there is no such alert."""
        alert = self._alerts.get(alert_id)
        if alert is None:
            return None
        if alert.acknowledged is None:
            alert = self._alerts[alert_id] = alert._replace(acknowledged=now, by=by)
        return alert

    def _judge(self, robot: str, name: str, link: AlertLink | None, now: float) -> Alert | None:
        """Return the alert of one link if it is new, worse or over; None if nothing has changed."""
        trouble = self._troubles.setdefault((robot, name), _Trouble())
        if link is None:
            return self._recover(robot, name, trouble, now)
        trouble.well_since = None
        lasting = OK
        for level in ORDER[1:]:
            if ORDER.index(link.level) < ORDER.index(level):
                trouble.since.pop(level, None)
            elif now - _before(trouble.since, level, now) >= self._raise_after[level]:
                lasting = level
        if lasting == OK:
            return None
        if not trouble.id:
            return self._raise(robot, trouble, link, lasting, now)
        alert = self._alerts[trouble.id]
        if ORDER.index(lasting) <= ORDER.index(alert.level):
            return None
        worse = alert._replace(level=lasting, sentence=link.sentence, acknowledged=None, by='')
        self._alerts[alert.id] = worse
        return worse

    def _raise(
        self, robot: str, trouble: _Trouble, link: AlertLink, level: str, now: float
    ) -> Alert:
        trouble.id = f'{robot}-{link.name}-{now:.3f}'.replace(' ', '_')
        alert = Alert(trouble.id, robot, link.name, level, link.sentence, now)
        self._alerts[alert.id] = alert
        while len(self._alerts) > MOST and self._over:
            self._alerts.pop(self._over.popleft(), None)
        return alert

    def _recover(self, robot: str, name: str, trouble: _Trouble, now: float) -> Alert | None:
        if trouble.well_since is None or now < trouble.well_since:
            trouble.well_since = now
        trouble.since.clear()
        if now - trouble.well_since < self._clear_after:
            return None
        del self._troubles[robot, name]
        if not trouble.id:
            return None
        over = self._alerts[trouble.id]._replace(cleared=trouble.well_since)
        self._alerts[over.id] = over
        self._over.append(over.id)
        return over


def _before(since: dict[str, float], level: str, now: float) -> float:
    """Return since when it has been so bad; from now on where a clock was set back."""
    if since.get(level, now) > now:
        since[level] = now
    return since.setdefault(level, now)


def _is_bad(link: AlertLink | None) -> bool:
    return link is not None and link.level != OK
