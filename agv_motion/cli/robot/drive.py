"""`agv drive`: send a robot somewhere, or see beforehand what that would ask of it."""

from __future__ import annotations

from dataclasses import replace
from math import degrees, radians
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from agv_motion.cli.robot.drive_goal import DriveGoal
from agv_motion.cli.robot.pose_text import parse_pose
from agv_motion.cli.terminal import terminal
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from agv_motion.nodes.ghost_trajectory import GhostTrajectoryParameters
    from agv_motion.planar import Pose
    from agv_motion.trajectory.ghost import Ghost
    from agv_motion.trajectory.trajectory import Trajectory

app = typer.Typer(
    no_args_is_help=True,
    help='Send a robot with the node ghost_trajectory somewhere: to poses, or along an arc.',
)

Speed = Annotated[float | None, typer.Option(help='Cruising speed [m/s]; else as the node has it.')]
Ramps = Annotated[float | None, typer.Option(help='Acceleration and braking [m/s2]; likewise.')]
DryRun = Annotated[bool, typer.Option('--dry-run', help='Tell what it asks for; nothing moves.')]
Plot = Annotated[Path | None, typer.Option(help='With --dry-run: draw it into this picture.')]
Start = Annotated[str, typer.Option(help='With --dry-run: X,Y,DEGREES where the robot starts.')]
Config = Annotated[str, typer.Option(help='With --dry-run: parameter file of the robot.')]
Namespace = Annotated[str, typer.Option(help='Of the robot, such as /hare.')]


@app.command(context_settings={'ignore_unknown_options': True})
def to(
    numbers: Annotated[
        list[str],
        typer.Argument(metavar='X Y DEGREES ...', help='Poses to reach, passing all but the last.'),
    ],
    *,
    speed: Speed = None,
    ramps: Ramps = None,
    delta: Annotated[
        float | None, typer.Option(help='Handles of the curves; 0: straight, turns on the spot.')
    ] = None,
    backward: Annotated[bool | None, typer.Option(help='Drive backwards.')] = None,
    namespace: Namespace = '',
    dry_run: DryRun = False,
    start: Start = '0,0,0',
    config: Config = 'differential.yaml',
    plot: Plot = None,
) -> None:
    """Drive to a pose, or through several without a stop: metres and degrees in the node's frame.

    Ctrl-C brakes the robot to rest. For example:

    agv drive to 2 1 90

    agv drive to 2 1 90 0 2 180 --speed 0.3 --dry-run --plot plan.png
    """
    poses = _poses(numbers)

    def plan(ghost: Ghost, given: GhostTrajectoryParameters) -> Trajectory:
        shape = given.delta_curve, given.speed_ramps, given.cruising_speed
        return ghost.compute_path(poses, *shape, backward=given.backward)

    changes = {
        'cruising_speed': speed, 'speed_ramps': ramps, 'delta_curve': delta, 'backward': backward,
    }  # fmt: skip
    goal = DriveGoal(plan, poses, None, {k: v for k, v in changes.items() if v is not None})
    _act(goal, namespace, dry_run=dry_run, start=start, config=config, plot=plot)


@app.command()
def arc(
    *,
    angle: Annotated[float, typer.Option(help='[degrees] above 0: centre on the left.')],
    diameter: Annotated[
        float, typer.Option(help="Of the inner wheel's circle [m]; 0: pivot on the inner wheel.")
    ],
    speed: Annotated[
        float | None, typer.Option(help='Of the outer wheel [m/s]; below 0: backwards.')
    ] = None,
    ramps: Ramps = None,
    namespace: Namespace = '',
    dry_run: DryRun = False,
    start: Start = '0,0,0',
    config: Config = 'differential.yaml',
    plot: Plot = None,
) -> None:
    """Drive an arc, given as a differential drive is told it: angle and inner diameter.

    Ctrl-C brakes the robot to rest. For example:

    agv drive arc --angle 90 --diameter 1.0

    agv drive arc --angle -180 --diameter 0 --speed -0.2 --dry-run
    """
    turn = radians(angle)

    def plan(ghost: Ghost, given: GhostTrajectoryParameters) -> Trajectory:
        pace = given.cruising_speed if speed is None else speed
        return ghost.compute_arc(turn, diameter, given.speed_ramps, pace)

    changes: dict[str, float | bool] = {} if ramps is None else {'speed_ramps': ramps}
    goal = DriveGoal(plan, [], (turn, diameter), changes)
    _act(goal, namespace, speed=speed, dry_run=dry_run, start=start, config=config, plot=plot)


def _act(
    goal: DriveGoal,
    namespace: str,
    *,
    speed: float | None = None,
    dry_run: bool,
    start: str,
    config: str,
    plot: Path | None,
) -> None:
    if dry_run:
        _tell(goal, start, config, plot)
        return
    if plot is not None:
        msg = '--plot draws a plan: give --dry-run too; of a drive, record it and use `agv plot`'
        raise ConfigurationError(msg)
    from agv_motion.cli.robot.drive_graph import DriveOrders

    if not DriveOrders(namespace).run(goal, speed, terminal()):
        raise typer.Exit(1)


def _tell(goal: DriveGoal, start: str, config: str, plot: Path | None) -> None:
    """Print what a goal asks for, and draw it."""
    from agv_motion.nodes.ghost_trajectory import GhostTrajectoryParameters
    from agv_motion.ros.config import find_config
    from agv_motion.ros.parameter_file import load_parameters
    from agv_motion.trajectory.ghost import Ghost

    given = load_parameters(find_config(config), 'ghost_trajectory', GhostTrajectoryParameters)
    given = replace(given, **goal.changes)  # type: ignore[arg-type]
    ghost = Ghost(parse_pose('--start', start), given.follow.ghost)
    trajectory = goal.plan(ghost, given)
    for line in ghost.report().lines():
        typer.echo(line)
    end = trajectory.end
    typer.echo(f'ends at {end.x:.3f} m, {end.y:.3f} m, {degrees(end.theta):.1f} degrees')
    if plot is not None:
        from agv_motion.cli.robot.robot_shape import shape_in
        from agv_motion.report.trajectory_figure import draw

        draw(trajectory, given.follow.ghost, plot, shape_in(find_config(config)))
        typer.echo(f'Figure: {plot}')


def _poses(numbers: list[str]) -> list[Pose]:
    """Return poses from x, y [m] and degrees, one after another."""
    if len(numbers) % 3:
        msg = f'{" ".join(numbers)}: a pose is three numbers, X Y DEGREES'
        raise ConfigurationError(msg)
    return [parse_pose('pose', ','.join(numbers[i : i + 3])) for i in range(0, len(numbers), 3)]
