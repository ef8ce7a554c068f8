"""A choice in one sentence of plain English: who drives, and why the others do not."""

from __future__ import annotations

from datetime import datetime, timezone
from typing import TYPE_CHECKING

from agv_motion.arbitration.choice import WAITING, Verdict
from agv_motion.arbitration.source import TwistSource

if TYPE_CHECKING:
    from agv_motion.arbitration.choice import Choice, HeldStop


def sentence(choice: Choice) -> str:
    """Return who drives or why nobody does, what a person can do, and who waits for what."""
    return '; '.join([_of_driver(choice), *_of_waiting(choice)])


def told(stop: HeldStop) -> str:
    """Return a STOP in words: why, and since when (UTC)."""
    return f'{stop.reason}, since {_time(stop.since)}'


def _time(seconds: float) -> str:
    try:
        moment = datetime.fromtimestamp(seconds, timezone.utc)
    except (OverflowError, ValueError, OSError):  # a clock that is no date
        return f'{seconds:.0f} s'
    return moment.strftime('%Y-%m-%d %H:%M:%S')


def _of_driver(choice: Choice) -> str:
    driver, hold = choice.driver, choice.hold
    if hold.stop is not None:
        return f'STOP: {told(hold.stop)}; release it by ~/stop with data: false'
    if driver is None:
        return 'nobody drives: no source speaks'
    verdict = choice.standings[driver].verdict
    release = f'~/lock_{driver.value} with data: false releases it'
    if verdict is Verdict.LOST:
        return f'{driver.value} fell silent while it drove: standing until it speaks; {release}'
    if verdict is Verdict.HOLDS:
        return f'{driver.value} is locked and silent: standing; {release}'
    return f'{driver.value} drives'


def _of_waiting(choice: Choice) -> list[str]:
    """Return who waits; those who wait for the same together."""
    waiting: dict[str, list[str]] = {}
    for source, standing in choice.standings.items():
        if standing.verdict in WAITING and source is not TwistSource.STOP:
            waiting.setdefault(standing.waits_for, []).append(source.value)
    return [f'{_listed(names)}: {reason}' for reason, names in waiting.items()]


def _listed(names: list[str]) -> str:
    if len(names) == 1:
        return f'{names[0]} waits'
    return f'{", ".join(names[:-1])} and {names[-1]} wait'
