"""`agv bag check`: what is wrong with a bag."""

from __future__ import annotations

from typing import Annotated

import typer
from rich.text import Text

from agv_motion.cli.bag.options import Bag
from agv_motion.cli.terminal import terminal
from agv_motion.errors import ConfigurationError
from agv_motion.visible import in_line


def check(
    bag: Bag,
    *,
    rate: Annotated[
        list[str] | None,
        typer.Option(help='What a topic should have, such as /odom=50 [Hz]; one per option.'),
    ] = None,
    tolerance: Annotated[
        float, typer.Option(min=0.0, help='Share by which a rate may be off.')
    ] = 0.1,
    gap: Annotated[
        float, typer.Option(min=1.0, help='Number of usual intervals that make a silence.')
    ] = 5.0,
    strict: Annotated[bool, typer.Option('--strict', help='Warnings are errors.')] = False,
) -> None:
    """Look for damage, CRC errors, NaN, stamps that go back, gaps, wrong rates, changed types.

    The exit status is 1 if there is an error. Silences, log times that go back and rates that
    change are warnings; a rate other than --rate says is an error. Examples:

    agv bag check walk

    agv bag check walk --rate /odom=50 --rate /cmd_vel=10 --strict
    """
    from agv_motion.bag.checks.check import Limits
    from agv_motion.bag.checks.check import check as findings
    from agv_motion.bag.completeness import completeness, together
    from agv_motion.bag.reader import BagReader

    limits = Limits(_rates(rate or []), tolerance, gap)
    counts = {'error': 0, 'warning': 0}
    with BagReader(bag) as reader, terminal(stderr=True).status('Looking') as status:

        def show(what: str) -> None:
            status.update(Text(f'Looking at {in_line(what)}'))

        for found in findings(reader, limits, show):
            counts[found.severity] += 1
            status.stop()  # a line of its own for each, on a terminal too
            typer.echo(f'{found.severity}: {in_line(found.where)}: {in_line(found.text)}')
            status.start()
        total, told = reader.message_count, completeness(reader)
    typer.echo(
        f'{counts["error"]} errors and {counts["warning"]} warnings in {total} messages of '
        f'{len(reader.topics)} topics' + (f'; the recording is {together(told)}' if told else '')
    )
    if counts['error'] or (strict and counts['warning']):
        raise typer.Exit(1)


def _rates(texts: list[str]) -> dict[str, float]:
    rates = {}
    for text in texts:
        topic, _, number = text.rpartition('=')
        try:
            rates[topic] = float(number)
        except ValueError:
            rates[topic] = -1.0
        if not (topic and 0.0 < rates[topic] < float('inf')):
            msg = f"--rate '{text}': give a topic and its rate in Hz, such as /odom=50"
            raise ConfigurationError(msg)
    return rates
