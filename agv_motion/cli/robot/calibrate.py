"""`agv calibrate`: what the measures of a robot really are, from a drive in a bag."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer
import yaml
from rich.table import Table

from agv_motion.cli.bag.options import opened
from agv_motion.cli.terminal import terminal
from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.files.unfinished import replacing

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.bag.reader import BagReader
    from agv_motion.odometry.calibration import Calibration
    from agv_motion.odometry.calibration_models import CalibrationModel
    from agv_motion.report.calibration_drive import Wheels

NINETY_FIVE = 1.96
"""Standard deviations to either side that hold 95 of 100 truths."""

TURRET_NOISE = 0.005
"""[m] of a turret's wheel after one metre: its node has no parameter for it."""

CONFIGS = {
    'omni_kinematics': 'omni.yaml',
    'differential_kinematics': 'differential.yaml',
    'wheel_kinematics': 'tree.yaml',
}
"""The node of each kind of base, and the file of config/ with its drawing."""


class Drawing(NamedTuple):
    """A base as its node's parameters draw it."""

    model: CalibrationModel
    wheels: Wheels
    wheel_noise: float
    written: Callable[[dict[str, float]], dict[str, Any]]
    """parameters of the node, from the unknowns by name"""


def calibrate(
    bag: Annotated[Path, typer.Argument(help='Bag of the drive: a folder, or one file.')],
    *,
    config: Annotated[
        str, typer.Option(help='Parameter file with the drawing: a path, or a file of config/.')
    ] = '',
    node: Annotated[
        str, typer.Option(help=f'Whose parameters: {", ".join(CONFIGS)}; else by the topics.')
    ] = '',
    namespace: Annotated[str, typer.Option(help='Of the robot in the bag.')] = '',
    reference: Annotated[
        str, typer.Option(help='Topic that tells places from outside; else fix or pose.')
    ] = '',
    wheel_noise: Annotated[
        float, typer.Option(min=0.0, help='Slip of a wheel after 1 m [m]; 0: as the drive shows.')
    ] = 0.0,
    output: Annotated[Path, typer.Option('--output', '-o', help='YAML to write.')] = Path(
        'calibrated.yaml'
    ),
) -> None:
    """Find out radii, distances, track or turret zeros from a drive with position fixes.

    Drive for some minutes, turning both ways and going in all directions: a motion that does not
    tell a measure leaves it as drawn, and says so; where it tells a combination of several, such
    as their mean, that is kept. The YAML can be used as it is. For example:

    agv demo omni

    agv calibrate demo_output/omni/bag -o calibrated.yaml

    agv run omni_kinematics --ros-args --params-file calibrated.yaml
    """
    from agv_motion.odometry.calibration import calibrate as fit
    from agv_motion.report.calibration_drive import read_drive
    from agv_motion.ros.config import find_config

    prefix = f'/{namespace.strip("/")}'.rstrip('/')
    with opened(bag) as reader:
        name = node or _node_of(reader, prefix)
        if name not in CONFIGS:
            msg = f"node = '{name}': choose one of {', '.join(CONFIGS)}"
            raise ConfigurationError(msg)
        drawing = _drawing(find_config(config or CONFIGS[name]), name, prefix)
        drive = read_drive(reader, drawing.wheels, reference, prefix)
        for note in drive.notes:
            typer.echo(note, err=True)
        found = fit(drawing.model, drive.recording, wheel_noise or drawing.wheel_noise)
        if not wheel_noise:
            typer.echo(f'slip of a wheel after 1 m: {1e3 * found.slip:.1f} mm')
            if found.slip_is_open:
                msg = (
                    f'{bag}: only wheels that slip by {1e2 * found.slip:.0f} cm a metre or more '
                    f'would explain the places of {drive.topic}: wrong places (reflections), or '
                    'another robot than the drawing; no parameters are written. Record a longer '
                    'drive, or give the slip with --wheel-noise'
                )
                raise SignalError(msg)
            found = fit(drawing.model, drive.recording, found.slip)
        _print(found, drive.topic)
        values = {unknown.name: unknown.value for unknown in found.unknowns}
        content = {f'{prefix or "/**"}/{name}': {'ros__parameters': drawing.written(values)}}
        with replacing(output) as made:
            made.write_text(yaml.safe_dump(content, sort_keys=False), encoding='utf-8')
        typer.echo(f'Parameters: {output}')


def _node_of(bag: BagReader, prefix: str) -> str:
    """Return whose robot is in the bag, by its topics and joints."""
    topics, path = bag.topics, bag.path
    if f'{prefix}/turrets/state' in topics:
        return 'wheel_kinematics'
    if f'{prefix}/wheels/state' in topics:
        free = f'{prefix}/wheels/free_speed' in topics
        return 'omni_kinematics' if free else 'differential_kinematics'
    msg = f'{path} has neither turrets/state nor wheels/state: it has {", ".join(sorted(topics))}'
    raise ConfigurationError(msg)


def _drawing(config: Path, node: str, prefix: str) -> Drawing:
    from agv_motion.nodes.catalogue import parameters_of
    from agv_motion.odometry.calibration_models import DifferentialModel, OmniModel, TurretModel
    from agv_motion.report.calibration_drive import Wheels, joints_of_turrets
    from agv_motion.ros.parameter_file import load_parameters

    given: Any = load_parameters(config, node, parameters_of(node))
    if node == 'wheel_kinematics':
        turrets = given.turrets()
        rolling, steering = joints_of_turrets(len(turrets))
        return Drawing(
            TurretModel(turrets, [given.wheel_radius] * len(turrets)),
            Wheels(f'{prefix}/turrets/state', rolling, steering),
            TURRET_NOISE,
            _turret_parameters,
        )
    noise, encoder_range = given.odometry.wheel_noise, given.odometry.encoder_range
    wheels = Wheels(f'{prefix}/wheels/state', list(given.joint_names), [], encoder_range)
    if node == 'differential_kinematics':
        track, track_drawn = given.track, given.track * given.track_multiplier
        return Drawing(
            DifferentialModel(track_drawn, given.wheel_radii),
            wheels,
            noise,
            lambda values: _differential_parameters(values, track),
        )
    return Drawing(OmniModel(given.wheels(), given.wheel_radii), wheels, noise, _omni_parameters)


def _all(values: dict[str, float], start: str) -> list[float]:
    return [round(value, 6) for name, value in values.items() if name.startswith(start)]


def _omni_parameters(values: dict[str, float]) -> dict[str, Any]:
    return {
        'wheel_radii': _all(values, 'radius_'),
        'wheel_distances': _all(values, 'distance_'),
    }


def _differential_parameters(values: dict[str, float], track: float) -> dict[str, Any]:
    return {
        'wheel_radii': _all(values, 'radius_'),
        'track_multiplier': round(values['track'] / track, 6),
    }


def _turret_parameters(values: dict[str, float]) -> dict[str, Any]:
    radii = _all(values, 'radius_')
    return {
        'wheel_radius': round(sum(radii) / len(radii), 6),  # the node has one for all wheels
        'steering_zero': _all(values, 'zero_'),
    }


def _print(found: Calibration, topic: str) -> None:
    table = Table(
        title=f'From {found.references} places of {topic}, {found.outliers} outliers left out',
        title_justify='left', box=None, pad_edge=False,
    )  # fmt: skip
    for column in ('measure', 'drawn', 'calibrated', '95 % interval', ''):
        table.add_column(column)
    for one in found.unknowns:
        spread = NINETY_FIVE * one.deviation
        table.add_row(
            one.name, f'{one.nominal:.5f} {one.unit}', f'{one.value:.5f} {one.unit}',
            f'+- {spread:.5f} {one.unit}',
            '' if one.determined else 'not told by this motion',
        )  # fmt: skip
    terminal().print(table)
    if found.carried:
        typer.echo(f'carried {found.carried} times: the drive is cut there')
    for names in found.undetermined:
        typer.echo(f'left open: {", ".join(names)}; drive so that they show apart from each other')
    if found.misfit > 2.0:
        typer.echo(
            f'the errors are {found.misfit**0.5:.1f} times what the noise says: slip, a bad '
            'reference, or another drawing; intervals are widened by that'
        )
