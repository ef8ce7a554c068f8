"""`agv sequence`: actions one after another, predicted or performed."""

from __future__ import annotations

from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from agv_motion.cli.lazy_group import HELP
from agv_motion.cli.robot.pose_text import parse_pose
from agv_motion.cli.terminal import LineTable, terminal

if TYPE_CHECKING:
    from agv_motion.nodes.sequence import SequenceParameters
    from agv_motion.sequence.prediction import Predicted


app = typer.Typer()


@app.command(context_settings=HELP | {'allow_extra_args': True, 'ignore_unknown_options': True})
def sequence(
    context: typer.Context,
    file: Annotated[
        str, typer.Argument(help='YAML with the actions: a path, or a file of config/.')
    ] = '',
    *,
    dry_run: Annotated[
        bool, typer.Option('--dry-run', help='Tell what would happen, and move nothing.')
    ] = False,
    plot: Annotated[
        Path | None, typer.Option(help='With --dry-run: draw it into this picture.')
    ] = None,
    start: Annotated[
        str, typer.Option(help='With --dry-run: X,Y,DEGREES where the robot stands.')
    ] = '0,0,0',
    config: Annotated[
        str,
        typer.Option(
            help='Parameter file with a section for the node sequence, or one of config/.'
        ),
    ] = '',
    actions: Annotated[
        bool, typer.Option('--actions', help='Tell which actions there are, with all their keys.')
    ] = False,
) -> None:
    """Perform a sequence of actions: go_to, rotate, arc, follow_route, wait.

    Waits for `odom`, plans everything from there, and drives by `cmd_vel`, or by
    `cmd_vel/sequence` where the robot has an arbiter; Ctrl-C brakes and ends it. The exit status
    is 0 when all was done. More arguments go to ROS.

    For example:

    agv sequence sequence_example.yaml --dry-run --plot sequence.png

    agv sequence patrol.yaml --ros-args -r cmd_vel:=/robot/cmd_vel -r odom:=/robot/odom

    agv sequence --actions
    """
    if actions:
        _explain()
        return
    if not file:
        typer.echo(context.get_help())
        return
    from agv_motion.ros.config import find_config

    parameters = find_config(config) if config else None
    if not dry_run:
        from agv_motion.cli.robot.sequence_run import perform

        perform(file, parameters, context.args)
        return
    if context.args:
        msg = f'unknown with --dry-run: {" ".join(context.args)}'
        raise typer.BadParameter(msg)
    _predict(file, parameters, start, plot)


def _parameters(config: Path | None) -> SequenceParameters:
    from agv_motion.nodes.sequence import SequenceParameters
    from agv_motion.ros.parameter_file import load_parameters

    return (
        load_parameters(config, 'sequence', SequenceParameters) if config else SequenceParameters()
    )


def _predict(file: str, config: Path | None, start: str, plot: Path | None) -> None:
    from agv_motion.ros.config import find_config
    from agv_motion.sequence.prediction import predict
    from agv_motion.sequence.sequence_file import load_sequence

    found = load_sequence(find_config(file))
    begin, given = parse_pose('--start', start), _parameters(config)
    predicted = predict(found, begin, given.tracking.ghost, given.follow)
    console = terminal()
    console.print(_summary(predicted))
    last = predicted[-1]
    length = sum(each.length for each in predicted)
    console.print(f'{found.name}: {last.begin + last.duration:.1f} s, {length:.2f} m')
    for each in predicted:
        if each.warning:
            console.print(f'Warning: {each.warning}', style='yellow', highlight=False)
    if plot is not None:
        from agv_motion.cli.robot.robot_shape import shape_in
        from agv_motion.report.sequence_figure import draw

        draw(found.name, begin, predicted, plot, shape_in(config) if config else None)
        console.print(f'Figure: {plot}')


def _summary(predicted: list[Predicted]) -> LineTable:
    table = LineTable()
    table.add_column('action', overflow='fold', no_wrap=False)
    for column in ('begin', 'takes', 'way', 'ends at', 'timeout'):
        table.add_column(column, justify='right', no_wrap=True)
    table.add_column('on failure', no_wrap=True)
    for i, each in enumerate(predicted, 1):
        x, y, theta = each.end
        table.add_row(
            f'{i} {each.step.name}', f'{each.begin:.1f} s', f'{each.duration:.1f} s',
            f'{each.length:.2f} m', f'{x + 0.0:.2f}, {y + 0.0:.2f}, {degrees(theta):.0f}°',
            f'{each.step.timeout:g} s', str(each.step.on_failure),
        )  # fmt: skip
    return table


def _explain() -> None:
    """Print every key of every action."""
    from agv_motion.cli.robot.sequence_keys import keys

    table = LineTable()
    for column in ('action', 'key', 'default', 'range', 'meaning'):
        table.add_column(column, overflow='fold')
    for row in keys():
        table.add_row(*row)
    terminal().print(table)
