"""`agv demo trees`: several trees share a square, and keep clear of each other."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from agv_motion.cli.demo.play import PAGE, begun, play


def trees(
    *,
    count: Annotated[int, typer.Option(min=2, max=5, help='How many trees.')] = 3,
    minutes: Annotated[float, typer.Option(min=0.1, help='Simulated minutes.')] = 40.0,
    time_factor: Annotated[
        float, typer.Option(min=0.1, max=100.0, help='Simulated seconds per second.')
    ] = 30.0,
    zone: Annotated[str, typer.Option(help='Zone: a path, or a file of config/.')] = '',
    seed: Annotated[int, typer.Option(min=0, help='Of starts, weather and noise.')] = 4,
    output: Annotated[Path, typer.Option(help='Folder of the results.')] = Path(
        'demo_output/trees'
    ),
    page: PAGE = True,
) -> None:
    """Let several trees share a zone for forty minutes, in two: five real nodes each.

    Each goes where its own sap and memory draw it, tells on /reservations which floor it holds, and
    walks only where no other objects. Leaves a bag (MCAP) and a figure.

    For example:

    agv demo trees

    agv demo trees --count 5 --minutes 60 --seed 7
    """
    console = begun()
    from agv_motion.demo.trees import TreesScenario

    play(
        TreesScenario(60.0 * minutes, count, zone, seed, time_factor),
        output,
        console,
        with_page=page,
    )
