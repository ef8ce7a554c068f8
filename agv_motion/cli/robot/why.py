"""`agv why`: why a robot does what it does, from its wheels back to its probes."""

from __future__ import annotations

import json
import time
from typing import TYPE_CHECKING, Annotated

import typer

from agv_motion.cli.graph.discovery import DISCOVERY
from agv_motion.cli.graph.session import joined, spin
from agv_motion.cli.terminal import terminal
from agv_motion.visible import in_line

if TYPE_CHECKING:
    from rich.text import Text

    from agv_motion.cli.robot.why_graph import RobotEars

REFRESH = 0.5
"""[s] between two pictures"""

WIDEST = 80
STYLES = ('', 'yellow', 'bold red', 'magenta')
"""by level; each line says its level in a word, too"""


def why(
    robot: Annotated[str, typer.Argument(help='Name (namespace) of a robot; all without.')] = '',
    *,
    once: Annotated[bool, typer.Option('--once', help='Tell it once, and end.')] = False,
    as_json: Annotated[bool, typer.Option('--json', help='As JSON, a line a robot; once.')] = False,
    spin_time: Annotated[float, typer.Option(help='Seconds to wait for discovery.')] = DISCOVERY,
) -> None:
    """Tell why a robot does what it does, or stands: from the wheels back to the first cause.

    On a terminal it goes on until Ctrl-C. Lines marked with > lead to the first cause.
    """
    from agv_motion.cli.robot.why_graph import RobotEars
    from agv_motion.explanation.text import plain

    console = terminal()
    live = console.is_terminal and not (once or as_json)
    with joined(spin_time, endless=live) as node:
        ears = RobotEars(node, robot)
        ears.gather()
        if as_json:
            for name, chain in ears.chains().items():
                typer.echo(json.dumps(plain(name, chain)))
        elif not live:
            console.print(_text(ears, WIDEST), soft_wrap=True, end='')
        else:
            from rich.live import Live

            with Live(console=console, auto_refresh=False) as screen:
                while True:
                    width = min(console.width, WIDEST)
                    screen.update(_text(ears, width), refresh=True)
                    end = time.monotonic() + REFRESH
                    spin(node, lambda end=end: time.monotonic() > end)  # type: ignore[misc]


def _text(ears: RobotEars, width: int) -> Text:
    """Return all chains, robot by robot."""
    from rich.text import Text

    from agv_motion.explanation.text import lines

    text = Text()
    for name, chain in ears.chains().items():
        for level, line in lines(name, chain, ears.time(), width, ears.time_zone(name)):
            text.append(f'{in_line(line)}\n', STYLES[level])
    return text
