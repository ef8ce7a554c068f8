"""Options of the commands that make bags out of bags, and how these are run and told of."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.progress import Progress

from agv_motion.cli.bag.many import jobs, outcomes_under_bar
from agv_motion.cli.bag.options import tell
from agv_motion.cli.terminal import terminal
from agv_motion.errors import ConfigurationError
from agv_motion.visible import indented

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.bag.editing.request import EditOutcome, EditRequest
    from agv_motion.bag.selection import Selection

Source = Annotated[Path, typer.Argument(help='Bag, or folder of bags.')]
Target = Annotated[Path, typer.Argument(help='Folder of the new bag, or bags; must not exist.')]
From = Annotated[
    str,
    typer.Option(
        '--from', help="Begin here: 90 [s after the start], -10 [s before the end], '14:32'."
    ),
]
To = Annotated[str, typer.Option('--to', help='Stop before this moment; forms as of --from.')]
Compression = Annotated[
    str, typer.Option('--compression', help='zstd, lz4 or none; else as it is.')
]
COMPRESSIONS = ('zstd', 'lz4', 'none')


def compression(given: str) -> str | None:
    """Return the compression that is asked for; None where none is.

    Raises:
        ConfigurationError: There is no such.

    """
    if given in (*COMPRESSIONS, ''):
        return given or None
    msg = f"--compression '{given}': choose one of {', '.join(COMPRESSIONS)}"
    raise ConfigurationError(msg)


def selection(
    topics: list[str] | None, regex: str, exclude_topics: list[str] | None, exclude_regex: str
) -> Selection:
    """Return the chosen topics: all, hidden ones too, unless some are named."""
    from agv_motion.bag.selection import Selection

    return Selection(
        everything=not (topics or regex),
        topics=tuple(topics or ()),
        regex=regex,
        exclude_topics=tuple(exclude_topics or ()),
        exclude_regex=exclude_regex,
        hidden=True,
    )


def edit_each(
    source: Path, target: Path, request: Any, workers: int = 1, scheduler: str = ''
) -> None:
    """Edit a bag, or each bag of a folder, under a bar, and tell what was done."""
    found = outcomes_under_bar('Writing', jobs([source], target), request, workers, scheduler)
    tell_outcomes(sorted(found))


def edit_together(sources: Sequence[Path], target: Path, request: EditRequest) -> None:
    """Make one bag of several, under a bar, and tell what was done."""
    with Progress(console=terminal(stderr=True), transient=True) as progress:
        bar = progress.add_task('Writing', total=1.0)
        outcome = request.make(sources, target, lambda share: progress.update(bar, completed=share))
    tell_outcomes([outcome])


def tell_outcomes(found: Sequence[EditOutcome]) -> None:
    """Print what was done with each bag; the exit status is 1 where something failed."""
    for one in found:
        tell(one.problems)
        for note in one.notes:
            typer.echo(f'note: {indented(note)}', err=True)
        if one.report is None:
            typer.echo(f'error: {one.source}: {indented(one.failure)}', err=True)
            continue
        report = one.report
        files = f' in {report.files} files' if report.files > 1 else ''
        chunks = f'{report.copied} chunks as they were, {report.made} new'
        typer.echo(
            f'{one.target}: {report.messages} messages{files}, {_size(one.before)} -> '
            f'{_size(one.after)}, {one.took:.2f} s ({chunks})'
        )
    if any(one.report is None for one in found):
        raise typer.Exit(1)


def _size(size: int) -> str:
    return f'{size / 1e6:.1f} MB' if size >= 1e5 else f'{size / 1e3:.1f} kB'
