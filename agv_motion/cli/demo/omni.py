"""`agv demo omni`: an omni robot that loses its way and finds it again."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from agv_motion.cli.bag.options import opened
from agv_motion.cli.terminal import terminal
from agv_motion.demo.domain import begin
from agv_motion.demo.folder import results


def omni(
    *,
    minutes: Annotated[float, typer.Option(min=0.1, help='Simulated minutes.')] = 5.0,
    time_factor: Annotated[
        float, typer.Option(min=0.1, max=100.0, help='Simulated seconds per second.')
    ] = 10.0,
    carry: Annotated[bool, typer.Option(help='Carry the robot away on its way.')] = True,
    seed: Annotated[int, typer.Option(min=0, help='Of the way and of all noise.')] = 1,
    output: Annotated[Path, typer.Option(help='Folder of the results.')] = Path('demo_output/omni'),
) -> None:
    """Let an omni robot find out where it is, in half a minute: UWB, wheels, and their fusion.

    Fixes of 15 cm come late, one in ten is an outlier, sometimes there are none; the wheels are
    not quite as drawn; and after two thirds of the time somebody carries the robot away. Leaves a
    bag (MCAP) and a figure. Its wheels can then be calibrated from the bag.

    For example:

    agv demo omni

    agv calibrate demo_output/omni/bag
    """
    from agv_motion.demo.omni import OmniGraph
    from agv_motion.report.localization import draw, read_run, summary

    console = terminal()
    begin(console)
    seconds = 60.0 * minutes
    carried = seconds / 1.5 if carry else 2 * seconds
    with results(output, 'path.png') as bag:
        OmniGraph(seed, time_factor, bag).run(seconds, carried, console)
        with opened(bag) as reader:
            run = read_run(reader)
            console.print(summary(run))
            draw(run, output / 'path.png')
            console.print(f'\nBag: {bag}\nFigure: {output / "path.png"}')
