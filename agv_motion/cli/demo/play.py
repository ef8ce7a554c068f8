"""How every demo is begun, and what is printed at its end."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from agv_motion.cli.bag.options import opened
from agv_motion.cli.terminal import terminal
from agv_motion.demo.domain import begin
from agv_motion.demo.folder import results
from agv_motion.demo.page import page

if TYPE_CHECKING:
    from rich.console import Console

    from agv_motion.demo.scenario import Scenario


def begun() -> Console:
    """Begin a demo before anything of ROS is imported, and return the console for it."""
    console = terminal()
    begin(console)
    return console


PAGE = Annotated[bool, typer.Option(help="Serve the operator's page while it runs.")]
"""option of every demo"""


def play(
    scenario: Scenario[Any], output: Path, console: Console, *, live: bool = True,
    with_page: bool = True,
) -> None:  # fmt: skip
    """Run a scenario, and leave its bag and its figure in ``output``; exits with 1 if it failed.

    Args:
        scenario: What sets the demo apart.
        output: Folder of the results.
        console: For what is printed.
        live: Show how it goes.
        with_page: Serve the operator's page meanwhile.

    """
    from agv_motion.demo.frame import Demo

    figure = output / scenario.figure
    with results(output, scenario.figure) as bag:
        with Demo(scenario, bag) as demo, page(bag, console, wanted=with_page):
            demo.run(console, live=live)
        word = scenario.last_word(demo)
        if word:
            console.print(word)
        with opened(bag) as reader:
            run = scenario.read(reader)
            for part in scenario.tell(run, demo):
                console.print(part)
            drawn = scenario.draw(run, figure)
            console.print(f'\nBag: {bag}' + (f'\nFigure: {figure}' if drawn else ''))
    if not scenario.succeeded:
        raise typer.Exit(1)
