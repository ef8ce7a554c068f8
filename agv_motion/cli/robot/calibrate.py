"""`agv calibrate`: what the measures of a robot really are, from a drive in a bag."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
import yaml

from agv_motion.cli.bag.options import opened
from agv_motion.cli.terminal import LineTable, terminal
from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.files.unfinished import replacing

if TYPE_CHECKING:
    from agv_motion.odometry.calibration import Calibration
    from agv_motion.report.calibration_drawing import Drawing
    from agv_motion.report.calibration_drive import RecordedDrive

NINETY_FIVE = 1.96
"""Standard deviations to either side that hold 95 of 100 truths."""

CONFIGS = {
    'omni_kinematics': 'omni.yaml',
    'differential_kinematics': 'differential.yaml',
    'wheel_kinematics': 'tree.yaml',
}
"""The node of each kind of base, and the file of config/ with its drawing."""

OF_ONE_NODE = ('steering_zero',)
"""What the node of the wheels alone knows; the rest is the shape of the robot, told once."""


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
    from agv_motion.nodes.catalogue import parameters_of
    from agv_motion.report.calibration_drawing import drawing_of, node_of
    from agv_motion.report.calibration_drive import read_drive
    from agv_motion.ros.config import find_config
    from agv_motion.ros.parameter_file import load_parameters

    prefix = f'/{namespace.strip("/")}'.rstrip('/')
    with opened(bag) as reader:
        name = node or node_of(reader, prefix)
        if name not in CONFIGS:
            msg = f"node = '{name}': choose one of {', '.join(CONFIGS)}"
            raise ConfigurationError(msg)
        given = load_parameters(find_config(config or CONFIGS[name]), name, parameters_of(name))
        drawing = drawing_of(name, given, prefix)
        drive = read_drive(reader, drawing.wheels, reference, prefix)
        for note in drive.notes:
            typer.echo(note, err=True)
        found = _fitted(drawing, drive, wheel_noise)
        _print(found, drive.topic)
        content = _sections(drawing, found, prefix, name)
        with replacing(output) as made:
            made.write_text(yaml.safe_dump(content, sort_keys=False), encoding='utf-8')
        typer.echo(f'Parameters: {output}')


def _fitted(drawing: Drawing, drive: RecordedDrive, wheel_noise: float) -> Calibration:
    """Return the fit to a drive, with the slip that is given, or else that the drive shows.

    Raises:
        SignalError: Only impossible slip would explain the places.

    """
    from agv_motion.odometry.calibration import calibrate as fit

    found = fit(drawing.model, drive.recording, wheel_noise or drawing.wheel_noise)
    if wheel_noise:
        return found
    typer.echo(f'slip of a wheel after 1 m: {1e3 * found.slip:.1f} mm')
    if found.slip_is_open:
        msg = (
            f'only wheels that slip by {1e2 * found.slip:.0f} cm a metre or more would explain the '
            f'places of {drive.topic}: wrong places (reflections), or another robot than the '
            'drawing; no parameters are written. Record a longer drive, or give the slip with '
            '--wheel-noise'
        )
        raise SignalError(msg)
    return fit(drawing.model, drive.recording, found.slip)


def _sections(drawing: Drawing, found: Calibration, prefix: str, node: str) -> dict[str, Any]:
    """Return the content of a parameter file: the shape for all nodes, the rest for one."""
    written = drawing.written({unknown.name: unknown.value for unknown in found.unknowns})
    own = {name: written.pop(name) for name in OF_ONE_NODE if name in written}
    sections = {f'{prefix}/**': written, f'{prefix or "/**"}/{node}': own}
    return {name: {'ros__parameters': values} for name, values in sections.items() if values}


def _print(found: Calibration, topic: str) -> None:
    table = LineTable(
        title=f'From {found.references} places of {topic}, {found.outliers} outliers left out',
        title_justify='left',
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
