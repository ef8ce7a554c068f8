"""`agv bag`: look into bags."""

from __future__ import annotations

import typer

from agv_motion.cli import bag_diff, bag_recover

app = typer.Typer(no_args_is_help=True, help='Look into bags.')
app.command()(bag_diff.diff)
app.command()(bag_recover.recover)
