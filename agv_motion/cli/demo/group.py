"""`agv demo`: the whole tree in one process, sixty times faster than life."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from agv_motion.cli.demo.play import PAGE, begun, play
from agv_motion.cli.lazy_group import lazy_group
from agv_motion.errors import ConfigurationError

app = typer.Typer(
    cls=lazy_group(
        {
            'trees': 'demo.trees:trees',
            'omni': 'demo.omni:omni',
            'differential': 'demo.differential:differential',
        }
    )
)


@app.callback(invoke_without_command=True)
def demo(
    context: typer.Context,
    *,
    probes: Annotated[Path | None, typer.Option(help='CSV file of recorded probes.')] = None,
    columns: Annotated[str, typer.Option(help='Its columns, separated by commas.')] = '',
    unit: Annotated[str, typer.Option(help='Their unit: K, mV, V or uV.')] = '',
    start: Annotated[str, typer.Option(help='Where to start in it, ISO 8601.')] = '',
    days: Annotated[float, typer.Option(min=0.01, help='How many days of it to play.')] = 7.0,
    minutes: Annotated[float, typer.Option(min=0.05, help='Simulated minutes.')] = 60.0,
    time_factor: Annotated[
        float, typer.Option(min=0.1, max=1000.0, help='Simulated seconds per second.')
    ] = 60.0,
    zone: Annotated[str, typer.Option(help='Zone: a path, or a file of config/.')] = '',
    seed: Annotated[int, typer.Option(min=0, help='Of weather and noise.')] = 1,
    output: Annotated[Path, typer.Option(help='Folder of the results.')] = Path('demo_output'),
    live: Annotated[bool, typer.Option(help='Show the walk while it runs.')] = True,
    page: PAGE = True,
) -> None:
    """Let the tree walk for one simulated hour: real nodes, one process, a minute.

    Leaves a bag (MCAP) and a figure in demo_output. Examples:
    agv demo
    agv demo --probes spruce.csv --days 7
    """
    if context.invoked_subcommand:
        return
    console = begun()
    from agv_motion.demo.tree import TreeScenario

    given: dict[str, Any] = {'simulated__seed': seed}
    if probes is None and (start or columns or unit):
        msg = '--start, --columns and --unit are of a recording: give its file by --probes'
        raise ConfigurationError(msg)
    if probes is not None:
        from agv_motion.demo.probes import Excerpt, recorded

        names = [name.strip() for name in columns.split(',') if name.strip()]
        given = recorded(probes, names, unit, Excerpt(start, days, minutes * 60.0))
        console.print(
            f'Playing {days:g} days of {probes} from {given["csv__start"]}: '
            f'{", ".join(given["csv__columns"])} [{given["csv__unit"]}]'
        )
    scenario = TreeScenario(minutes * 60.0, given, zone, seed, time_factor)
    play(scenario, output, console, live=live, with_page=page)
