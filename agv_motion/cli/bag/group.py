"""`agv bag`: look into bags, and make bags out of bags."""

from __future__ import annotations

import typer

from agv_motion.cli.lazy_group import lazy_group

app = typer.Typer(
    cls=lazy_group(
        {
            'info': 'bag.info:info',
            'echo': 'bag.echo:echo',
            'hz': 'bag.rates:hz',
            'gaps': 'bag.rates:gaps',
            'check': 'bag.check:check',
            'plot': 'bag.plot:plot',
            'export': 'bag.export:export',
            'recover': 'bag.recover:recover',
            'diff': 'bag.diff:diff',
            'errors': 'bag.errors:errors',
            'cut': 'bag.cut:cut',
            'filter': 'bag.rewrite:choose',
            'merge': 'bag.merge:merge',
            'split': 'bag.rewrite:split',
            'convert': 'bag.rewrite:convert',
            'compress': 'bag.rewrite:compress',
            'sort': 'bag.rewrite:sort',
            'note': 'bag.note:note',
            'list': 'bag.content:contents',
            'du': 'bag.content:du',
            'index': 'bag.catalog:index',
            'find': 'bag.catalog:find',
            'stats': 'bag.catalog:stats',
        }
    ),
    no_args_is_help=True,
)


@app.callback()
def bag() -> None:
    """Look into bags, and make bags out of bags."""
