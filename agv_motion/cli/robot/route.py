"""`agv route`: how a robot would follow a route, before it does."""

from __future__ import annotations

from dataclasses import replace
from math import isinf
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from agv_motion.cli.robot.pose_text import parse_pose
from agv_motion.cli.terminal import LineTable, terminal
from agv_motion.planar import Pose

if TYPE_CHECKING:
    from agv_motion.route.prediction import Prediction
    from agv_motion.route.route import Route


def route(
    file: Annotated[str, typer.Argument(help='Route, CSV or YAML: a path, or a file of config/.')],
    *,
    config: Annotated[
        str, typer.Option(help='Parameter file of the node route_follower.')
    ] = 'route.yaml',
    laps: Annotated[int | None, typer.Option(min=1, help='Rounds, whatever the file says.')] = None,
    start: Annotated[
        str, typer.Option(help='X,Y,DEGREES where the robot starts; else on the route.')
    ] = '',
    holonomic: Annotated[
        bool | None, typer.Option(help='Whether the base can go sideways; else as the config says.')
    ] = None,
    distance: Annotated[
        float | None, typer.Option(help='Of the virtual point [m], to try another.')
    ] = None,
    plot: Annotated[Path | None, typer.Option(help='Draw it into this picture.')] = None,
) -> None:
    """Predict how a robot follows a route: time, how far off it cuts corners, what slows it down.

    An ideal robot, that does at once what it is told, follows the route with the tables of the
    configuration. Copy config/route.yaml, change a table, and look again.

    For example:

    agv route route_example.yaml --plot route.png

    agv route survey.csv --laps 3 --distance 0.8

    agv run route_follower --ros-args -p route_file:=survey.csv
    """
    from agv_motion.nodes.route_follower import RouteFollowerParameters
    from agv_motion.ros.config import find_config
    from agv_motion.ros.parameter_file import load_parameters
    from agv_motion.route.prediction import predict
    from agv_motion.route.route import Route
    from agv_motion.route.route_file import load_route

    given = load_parameters(find_config(config), 'route_follower', RouteFollowerParameters)
    follow = given.follow
    if holonomic is not None:
        follow = replace(follow, holonomic=holonomic)
    if distance is not None:
        follow = replace(follow, virtual_point_distance=distance)
    found = load_route(find_config(file), given.laps)
    if laps is not None:
        found = Route(found.waypoints, laps)
    run = predict(found, follow, _start(start, found), 1.0 / given.rate, limits=given.limits)
    console = terminal()
    console.print(_summary(found, run))
    for warning in filter(None, (follow.orbit(), _unfinished(found, run))):
        console.print(f'Warning: {warning}', style='yellow', highlight=False)
    if plot is not None:
        from agv_motion.cli.robot.robot_shape import shape_in
        from agv_motion.report.route_figure import draw

        draw(found, run, plot, shape_in(find_config(config)))
        console.print(f'Figure: {plot}')


def _start(text: str, found: Route) -> Pose:
    """Return the start that was given, or the first waypoint, looking along the route."""
    from math import atan2

    first = found.segments[0]
    if not text:
        return Pose(*first.start, atan2(first.uy, first.ux))
    return parse_pose('--start', text)


def _unfinished(found: Route, run: Prediction) -> str:
    if run.arrived or isinf(found.length):
        return ''
    return f'the robot has not arrived after {run.duration:.0f} s: look at v_dphi and omega_dphi'


def _summary(found: Route, run: Prediction) -> LineTable:
    table = LineTable(show_header=False)
    rms, most = run.cross_track(found)
    laps = '' if found.laps == 1 else f', {found.laps or "endless"} laps'
    table.add_row('route', f'{len(found.waypoints)} waypoints, {found.length:.2f} m{laps}')
    table.add_row('duration', f'{run.duration:.1f} s' + ('' if run.arrived else ', not arrived'))
    table.add_row('off the route', f'{rms:.3f} m root mean square, {most:.3f} m at most')
    for i, (name, share) in enumerate(run.limiter_shares().items()):
        table.add_row('' if i else 'held down by', f'{name:9s} {100 * share:3.0f} % of the time')
    return table
