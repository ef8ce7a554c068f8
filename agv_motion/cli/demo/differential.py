"""`agv demo differential`: a differential drive that performs a sequence of actions."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from agv_motion.cli.demo.play import PAGE, begun, play


def differential(
    *,
    sequence: Annotated[
        str, typer.Option(help='Sequence of actions: a path, or a file of config/.')
    ] = 'sequence_example.yaml',
    time_factor: Annotated[
        float, typer.Option(min=0.1, max=20.0, help='Simulated seconds per second.')
    ] = 2.0,
    seed: Annotated[int, typer.Option(min=0, help='Of slip and noise.')] = 1,
    output: Annotated[Path, typer.Option(help='Folder of the results.')] = Path(
        'demo_output/differential'
    ),
    page: PAGE = True,
) -> None:
    """Let a differential drive perform a sequence: poses, turns, an arc, a route, and home again.

    Its wheels slip by 5 and 2 %, its motors lag, its camera errs by a centimetre. Leaves a bag
    (MCAP) and a figure of what was planned and what was driven. Examples:

    agv demo differential

    agv demo differential --sequence patrol.yaml --time-factor 1
    """
    console = begun()
    from agv_motion.demo.differential import DifferentialScenario

    play(DifferentialScenario(sequence, seed, time_factor), output, console, with_page=page)
