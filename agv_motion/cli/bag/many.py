"""Which bags are meant: one, or all in a folder; and the work over all of them, under a bar."""

from __future__ import annotations

from contextlib import closing
from typing import TYPE_CHECKING, Annotated, TypeVar

import typer
from rich.progress import Progress

from agv_motion.cli.terminal import terminal
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from agv_motion.ros.many_bags import Work

Outcome = TypeVar('Outcome')

Workers = Annotated[
    int, typer.Option('-j', '--workers', min=1, help='Bags at the same time, on this machine.')
]
Scheduler = Annotated[
    str, typer.Option(help='... or on the Dask cluster of this scheduler, as tcp://host:8786.')
]


def jobs(sources: Sequence[Path], target: Path) -> list[tuple[Path, Path]]:
    """Return each bag with where its result goes: in ``target``, or there itself if it is one.

    Raises:
        ConfigurationError: There is no bag, or two of the same name.

    """
    if len(sources) == 1 and (is_bag(sources[0]) or not sources[0].is_dir()):
        return [(sources[0], target)]
    found = [
        bag
        for source in sources
        for bag in ([source] if is_bag(source) else sorted(filter(is_bag, source.iterdir())))
    ]
    results = {target / bag.stem for bag in found}
    if not found or len(results) < len(found):
        what = 'two bags of the same name' if found else 'no bag'
        msg = f'{what} in {", ".join(map(str, sources))}: give bags, or folders of bags'
        raise ConfigurationError(msg)
    return [(bag, target / bag.stem) for bag in found]


def is_bag(path: Path) -> bool:
    """Return whether there is a bag: a folder with its files, or a file."""
    if path.is_dir():
        return any(path.glob('*.mcap*')) or any(path.glob('*.db3*'))
    return path.suffix in {'.mcap', '.db3'}


def outcomes_under_bar(
    doing: str, pairs: list[tuple[Path, Path]], work: Work[Outcome], workers: int, scheduler: str
) -> list[Outcome]:
    """Return what became of every bag, in no order, while a bar shows how far it is."""
    from agv_motion.ros.many_bags import outcomes

    found: list[Outcome] = []
    with Progress(console=terminal(stderr=True), transient=True) as progress:
        bar = progress.add_task(doing, total=len(pairs))

        def show(share: float) -> None:
            progress.update(bar, completed=len(found) + share)

        with closing(outcomes(pairs, work, workers, scheduler, show)) as coming:
            for outcome in coming:
                found.append(outcome)
                show(0.0)
    return found
