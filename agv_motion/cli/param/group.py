"""`agv param`: the words, options and output of `ros2 param`, for a machine without it."""

from __future__ import annotations

import typer

from agv_motion.cli.lazy_group import lazy_group

app = typer.Typer(
    cls=lazy_group(
        {
            'list': 'param.look:list_',
            'get': 'param.look:get',
            'describe': 'param.look:describe',
            'set': 'param.change:set_app',
            'dump': 'param.change:dump',
            'load': 'param.change:load',
        }
    ),
    no_args_is_help=True,
)


@app.callback()
def param() -> None:
    """Parameters of running nodes, with the words and the output of `ros2 param`."""
