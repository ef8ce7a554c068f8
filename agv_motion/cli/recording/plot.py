"""`agv plot`: a run in a bag, planned against driven, and the errors over time."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from agv_motion.cli.bag.options import opened

if TYPE_CHECKING:
    from agv_motion.report.run import RunBag
    from agv_motion.report.run_errors import Errors


def plot(
    bag: Annotated[Path, typer.Argument(help='Bag of the run: a folder, or one file.')],
    *,
    output: Annotated[Path, typer.Option('--output', '-o', help='Picture to draw.')] = Path(
        'run.png'
    ),
    planned: Annotated[
        str, typer.Option(help='Topic of the plan in time; else ghost/pose, where it is.')
    ] = '',
    driven: Annotated[
        str, typer.Option(help='Topic of the robot; else ground_truth, pose or odom.')
    ] = '',
    dark: Annotated[bool, typer.Option('--dark', help='Light on dark.')] = False,
) -> None:
    """Draw a run: where the robot was to be, where it was, and how far apart they were.

    Without a Ghost in the bag the way, all paths that were shown, and the speed are drawn. A plan
    that has not been driven yet is drawn by `agv drive ... --dry-run --plot`. For example:

    agv record -a -o lap

    agv plot lap -o lap.png

    agv plot lap --driven odom
    """
    from agv_motion.report.run import read_run
    from agv_motion.report.run_figure import draw

    with opened(bag) as reader:
        run = read_run(reader, planned, driven)
        draw(run, _told(run), output, theme='dark' if dark else 'light')
        typer.echo(f'Figure: {output}')


def _told(run: RunBag) -> Errors | None:
    """Print how long and far the robot went, and its errors, which are returned if there are."""
    from agv_motion.report.run_errors import errors_between

    typer.echo(f'{run.driven.topic}: {run.duration():.1f} s, {run.distance():.2f} m')
    if run.planned is None:
        return None
    if run.planned.frame != run.driven.frame:
        typer.echo(
            f"warning: {run.planned.topic} is in '{run.planned.frame}', {run.driven.topic} in "
            f"'{run.driven.frame}': choose another --driven", err=True,
        )  # fmt: skip
    errors = errors_between(run.planned, run.driven)
    if not len(errors.time):
        return None
    worst = int(errors.distance.argmax())
    typer.echo(
        f'from {run.planned.topic}: root mean square {100 * errors.rms():.2f} cm, '
        f'at most {100 * errors.distance[worst]:.2f} cm '
        f'({errors.time[worst] - run.driven.time[0]:.1f} s after the start)'
    )
    return errors
