"""`agv bag recover`: save what can be read of a damaged bag."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.progress import Progress

from agv_motion.cli.terminal import terminal
from agv_motion.visible import indented

MOST_PROBLEMS = 20
"""that are told"""


def recover(
    damaged: Annotated[Path, typer.Argument(help='Damaged bag: its folder, or one file.')],
    saved: Annotated[Path, typer.Argument(help='Folder of the new bag; must not exist.')],
    *,
    compression: Annotated[str, typer.Option(help='zstd, lz4 or none.')] = 'zstd',
) -> None:
    """Save every message that can be read into a new bag, with a new index.

    The damaged bag stays as it is, and the new one appears when it is whole. A file that was cut
    off is saved up to its last whole message; chunks that are damaged, and rows of a damaged
    sqlite3 file, are left out and told. The exit status is 1 if something is lost.
    For example:

    agv bag recover walk walk_saved

    agv bag recover walk/walk_0.mcap walk_saved
    """
    from agv_motion.bag.bag_files import find
    from agv_motion.bag.editing.recovery import Recovery
    from agv_motion.bag.notes import carry
    from agv_motion.bag.writer import BagWriter
    from agv_motion.files.unfinished import beside, told

    find(damaged)
    with (
        beside(saved) as made,
        told(saved),
        BagWriter(made, compression=compression) as writer,
    ):
        recovery = Recovery(writer)
        with Progress(console=terminal(stderr=True), transient=True) as bar:
            task = bar.add_task('Saving', total=1.0)
            recovery.save(damaged, lambda share: bar.update(task, completed=share))
        carry([damaged], made, None)
    for problem in recovery.problems[:MOST_PROBLEMS]:
        typer.echo(f'found: {indented(problem)}', err=True)
    if len(recovery.problems) > MOST_PROBLEMS:
        typer.echo(f'found: {len(recovery.problems) - MOST_PROBLEMS} more', err=True)
    lost = f'; at least {recovery.missing} of {damaged} are lost' if recovery.missing else ''
    typer.echo(f'Saved {recovery.messages} messages in {saved}{lost}')
    harmless = all(getattr(problem, 'harmless', False) for problem in recovery.problems)
    if not harmless or recovery.missing:
        raise typer.Exit(1)
