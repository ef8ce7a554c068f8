"""`agv parameters`: what each parameter of a node means, without starting it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from agv_motion.cli.graph.completion import one_of
from agv_motion.cli.terminal import LineTable, terminal
from agv_motion.nodes.catalogue import available, parameters_of
from agv_motion.parameters import nested, rows

if TYPE_CHECKING:
    from collections.abc import Iterator

COLUMNS = ('parameter', 'default', 'range', 'meaning')


class Description(NamedTuple):
    """One parameter as a person reads it."""

    name: str
    default: str
    allowed: str
    meaning: str


def describe(kind: type[Any], prefix: str = '') -> Iterator[Description]:
    """Yield the parameters of a dataclass, groups as dotted names."""
    defaults = kind()
    for name, _, spec in rows(kind):
        value = getattr(defaults, name)
        allowed = ', '.join(spec.choices)
        if spec.between:
            allowed = '{:g} to {:g}'.format(*spec.between)
        unit = f' [{spec.unit}]' if spec.unit not in {'', '1'} else ''
        dynamic = '; may change at run time' if spec.dynamic else ''
        shown = [_short(item) for item in value] if isinstance(value, tuple) else _short(value)
        default = f'[{", ".join(shown)}]' if isinstance(shown, list) else shown
        yield Description(prefix + name, default, allowed, spec.description + unit + dynamic)
    for name, group in nested(kind):
        yield from describe(group, f'{prefix}{name}.')


def markdown(kind: type[Any]) -> str:
    """Return the parameters of a dataclass as a table of Markdown."""
    lines = [f'| {" | ".join(COLUMNS)} |', f'|{"---|" * len(COLUMNS)}']
    lines += [
        f'| `{row.name}` | `{row.default}` | {row.allowed} | {row.meaning} |'
        for row in describe(kind)
    ]
    return '\n'.join([*lines, ''])


def _short(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return f'{value:.4g}' if isinstance(value, float) else repr(value)


def parameters(
    node: Annotated[
        str,
        typer.Argument(
            help='Name of the node, such as wheel_kinematics.', autocompletion=one_of(available)
        ),
    ],
    *,
    as_markdown: Annotated[
        bool, typer.Option('--markdown', help='As a table for a README.')
    ] = False,
) -> None:
    """Tell every parameter of a node: default, range, unit and meaning.

    Example: agv parameters granier_probe
    """
    kind = parameters_of(node)
    if as_markdown:
        typer.echo(markdown(kind), nl=False)
        return
    table = LineTable()
    for column in COLUMNS:
        table.add_column(column, overflow='fold')
    for row in describe(kind):
        table.add_row(*row)
    terminal().print(table)
