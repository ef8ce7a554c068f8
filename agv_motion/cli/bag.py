"""`agv bag`: look into bags."""

from __future__ import annotations

import typer

from agv_motion.cli import (
    bag_check,
    bag_diff,
    bag_echo,
    bag_export,
    bag_info,
    bag_plot,
    bag_rates,
    bag_recover,
)

app = typer.Typer(no_args_is_help=True, help='Look into bags.')
for verb in (
    bag_info.info, bag_echo.echo, bag_rates.hz, bag_rates.gaps, bag_check.check,
    bag_plot.plot, bag_export.export,     bag_recover.recover, bag_diff.diff,
):  # fmt: skip
    app.command()(verb)
