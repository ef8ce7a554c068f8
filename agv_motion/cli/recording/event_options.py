"""What a recording takes for an event: options of `agv record`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

Trigger = Annotated[
    list[str] | None,
    typer.Option(help="Save the time around: '/state ~ stopped', '/odom/speed > 1'; repeatable."),
]
Before = Annotated[float, typer.Option(help='Seconds that are saved before an event.')]
After = Annotated[float, typer.Option(help='... and after it.')]
Events = Annotated[Path | None, typer.Option(help='Folder of events; else events, beside the bag.')]
OnlyEvents = Annotated[
    bool, typer.Option('--only-events', help='Keep what events may need, and at the end only them.')
]


def event_parameters(
    trigger: list[str] | None, before: float, after: float, events: Path | None,
    *, only_events: bool,
) -> dict[str, Any]:  # fmt: skip
    """Return the parameters of the recorder; an empty list is no parameter."""
    given = {'before': before, 'after': after, 'events': str(events or '')}
    return {**given, 'only_events': only_events, **({'trigger': trigger} if trigger else {})}
