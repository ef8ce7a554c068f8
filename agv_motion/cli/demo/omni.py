"""`agv demo omni`: an omni robot that loses its way and finds it again."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from agv_motion.cli.demo.play import PAGE, begun, play


def omni(
    *,
    minutes: Annotated[float, typer.Option(min=0.1, help='Simulated minutes.')] = 5.0,
    time_factor: Annotated[
        float, typer.Option(min=0.1, max=100.0, help='Simulated seconds per second.')
    ] = 10.0,
    carry: Annotated[bool, typer.Option(help='Carry the robot away on its way.')] = True,
    seed: Annotated[int, typer.Option(min=0, help='Of the way and of all noise.')] = 1,
    output: Annotated[Path, typer.Option(help='Folder of the results.')] = Path('demo_output/omni'),
    page: PAGE = True,
) -> None:
    """Let an omni robot find out where it is, in half a minute: UWB, wheels, and their fusion.

    Fixes of 15 cm come late, one in ten is an outlier, sometimes there are none; the wheels are
    not quite as drawn; and after two thirds of the time somebody carries the robot away. Leaves a
    bag (MCAP) and a figure. Its wheels can then be calibrated from the bag.

    For example:

    agv demo omni

    agv calibrate demo_output/omni/bag
    """
    console = begun()
    from agv_motion.demo.omni import OmniScenario

    scenario = OmniScenario(60.0 * minutes, carry=carry, seed=seed, time_factor=time_factor)
    play(scenario, output, console, with_page=page)
