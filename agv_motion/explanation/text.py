"""A chain as text for a terminal, or as plain objects for a program."""

from __future__ import annotations

from textwrap import wrap
from typing import TYPE_CHECKING, Any

from agv_motion.explanation.words import ago, clock

if TYPE_CHECKING:
    from collections.abc import Iterator

    from agv_motion.explanation.link import Chain, Link

MARKS = ('ok', 'WARN', 'ERROR', 'STALE')
"""by level; colour is never alone"""

NAME, MARK = 10, 6
"""[1] characters of the two columns before the sentences"""


def lines(
    robot: str, chain: Chain, time: float, width: int = 80, time_zone: str = 'UTC'
) -> list[tuple[int, str]]:
    """Return the lines of a chain, each with its level.

    Args:
        robot: Its name.
        chain: To tell.
        time: Now, by the robot's clock [s since 1970].
        width: Characters of a line.
        time_zone: In which times are told.

    """
    head = wrap(f'{robot}: {chain.headline}', width, subsequent_indent='  ')
    found = [(int(chain.level), line) for line in head]
    on_the_way = {link.name for link in chain.way()}
    for link in chain.links:
        arrow = '>' if link.name in on_the_way else ' '
        text = _told(link, time, time_zone)
        first = f'{arrow} {link.name:<{NAME}}{MARKS[link.level]:<{MARK}}'
        indent = ' ' * len(first)
        found += [
            (int(link.level), line)
            for line in wrap(text, width, initial_indent=first, subsequent_indent=indent)
        ]
        if link.remedy:
            rest = wrap(link.remedy, width, initial_indent=f'{indent}-> ',
                        subsequent_indent=f'{indent}   ')  # fmt: skip
            found += [(int(link.level), line) for line in rest]
    return found


def _told(link: Link, time: float, time_zone: str) -> str:
    return '; '.join([link.sentence, *_more(link, time, time_zone)])


def _more(link: Link, time: float, time_zone: str) -> Iterator[str]:
    if link.limit:
        yield link.limit if link.limit.startswith('is ') else f'limited by {link.limit}'
    since = clock(link.since, time, time_zone)
    if since and f'since {since}' not in link.sentence:
        yield f'since {since}'
    if link.age is not None and link.age >= 1.5 and ago(link.age) not in link.sentence:
        yield f'{ago(link.age)} old'


def plain(robot: str, chain: Chain) -> dict[str, Any]:
    """Return a chain as objects that JSON has."""
    return {
        'robot': robot,
        'headline': chain.headline,
        'level': chain.level.name,
        'cause': chain.cause.name,
        'remedy': chain.cause.remedy,
        'links': [link._asdict() | {'level': link.level.name} for link in chain.links],
    }
