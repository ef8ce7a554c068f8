"""Marks: a moment with a few words, for all who record and for the timeline of the page."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from agv_motion.bag.notes import notes_of
from agv_motion.dashboard.server.door import Asked, Door, acting
from agv_motion.dashboard.server.requests import RequestError, text

if TYPE_CHECKING:
    from starlette.routing import Route

    from agv_motion.dashboard.server.site import Site

SHOWN = 200
"""newest marks that the page shows"""
SECOND = 1_000_000_000
LONGEST = 300
"""characters of a mark"""


def mark_doors(site: Site) -> list[Route]:
    """Return the doors to marks, and show those there are."""
    show(site)
    return [acting(site, Door('/mark', _mark, ('text',)))]


def show(site: Site) -> None:
    """Put the newest marks on the board."""
    site.fleet.board.put('', 'marks', site.fleet.now(), marks(site))


def marks(site: Site) -> list[dict[str, Any]]:
    """Return the newest marks, newest first, and then what is noted in the bag that is recorded."""
    noted = [] if site.history is None else notes_of(site.history.bag)[-SHOWN:]
    notes = [
        {
            'id': -number,
            'at': note.stamp / SECOND,
            'text': note.text[:LONGEST],
            'by': 'agv bag note',
        }
        for number, note in enumerate(reversed(noted), 1)
    ]
    if site.store is None:
        return notes
    rows = site.store.rows('SELECT id, at, text, by FROM marks ORDER BY id DESC LIMIT ?', (SHOWN,))
    return [{'id': i, 'at': at, 'text': words, 'by': by} for i, at, words, by in rows] + notes


def _mark(asked: Asked) -> dict[str, Any]:
    """Keep a mark at the time of the robots, as a bag of them has it, and publish it."""
    site = asked.site
    if site.store is None or site.recorded:
        raise RequestError(409, 'this is a recording: nothing can be done in it')
    words = text(asked.told, 'text', LONGEST, least=1)
    board = site.fleet.board
    at = board.time_of_robots(site.fleet.now())
    site.store.change(
        'INSERT INTO marks (at, text, by) VALUES (?, ?, ?)', (at, words, asked.visitor.name)
    )
    show(site)
    return {'id': site.acts.begin([''], 'mark', {'text': words})}
