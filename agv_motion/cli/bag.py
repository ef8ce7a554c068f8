"""`agv bag`: look into bags."""

from __future__ import annotations

import typer

from agv_motion.cli.lazy_group import lazy_group

app = typer.Typer(
    cls=lazy_group(
        {
            'info': 'bag_info:info',
            'echo': 'bag_echo:echo',
            'hz': 'bag_rates:hz',
            'gaps': 'bag_rates:gaps',
            'check': 'bag_check:check',
            'plot': 'bag_plot:plot',
            'export': 'bag_export:export',
            'recover': 'bag_recover:recover',
            'diff': 'bag_diff:diff',
        }
    ),
    no_args_is_help=True,
)


@app.callback()
def bag() -> None:
    """Look into bags."""
