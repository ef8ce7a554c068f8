"""Draw the walk of a tree in the bag of its demo as an animation, the one at the top of README.

launch_scripts/demo
python launch_scripts/pictures/animation.py demo_output/bag -o resource/walk.gif
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import matplotlib as mpl
import numpy as np
import typer
from matplotlib import pyplot as plt
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LinearSegmentedColormap
from PIL import Image

from agv_motion.bag.reader import BagReader
from agv_motion.kinematics.platform import PLATFORM_RADIUS
from agv_motion.model.footprint import disc
from agv_motion.motion.navigation.zone_file import load_zone
from agv_motion.report import label_layout, style
from agv_motion.report.recorded_footprint import read_footprints
from agv_motion.report.robot_drawing import draw_robot
from agv_motion.report.walk import WalkRun, read_walk
from agv_motion.report.walk_figure import finding
from agv_motion.ros.config import find_config

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from agv_motion.model.footprint import Footprint
    from agv_motion.motion.navigation.zone import Zone

FRAMES, EVERY = 90, 90
"""Pictures, and how long each is shown [ms]."""

SIZE, DOTS_PER_INCH = (9.0, 3.9), 100


def main(
    bag: Annotated[Path, typer.Argument(help='Bag of `agv demo`.')],
    output: Annotated[Path, typer.Option('--output', '-o', help='GIF to write.')] = Path(
        'walk.gif'
    ),
    zone: Annotated[str, typer.Option(help='Zone file.')] = 'zone_outdoor.yaml',
) -> None:
    """Draw an animation of a walk: where the tree goes and why, and what it felt."""
    with BagReader(bag) as reader:
        run = read_walk(reader, 0.1)
        if not len(run.path):
            msg = f'{bag}: nobody tells ground_truth in it: give a bag of agv demo'
            raise typer.BadParameter(msg)
        stamps = (times(run, FRAMES) + reader.start * 1e-9).tolist()
        shapes = read_footprints(reader, '/ground_truth', stamps)
    if shapes is None:
        typer.echo(
            f'{bag}: no robot_description in it, so the tree is a disc of {PLATFORM_RADIUS} m '
            'without wheels; record with the node robot_model on the graph, as agv demo does',
            err=True,
        )
    write(run, load_zone(find_config(zone), PLATFORM_RADIUS), output, shapes)
    typer.echo(f'Animation: {output}, {output.stat().st_size / 1e6:.2f} MB')


def times(run: WalkRun, frames: int) -> NDArray[np.float64]:
    """Return when each picture is taken [s]."""
    return np.linspace(0.0, float(run.path[-1, 0]), frames)


def write(
    run: WalkRun, zone: Zone, output: Path, shapes: Sequence[Footprint] | None,
    frames: int = FRAMES,
) -> None:  # fmt: skip
    """Write the animation of a walk as a GIF; ``shapes`` are of the tree, one for each picture."""
    mpl.use('Agg')
    pictures, found = [], finding(run, zone, PLATFORM_RADIUS)
    with mpl.rc_context(style.settings()):
        for i, time in enumerate(times(run, frames)):
            drawn, axes = plt.subplot_mosaic(
                [['map', 'flow'], ['map', 'speed']], figsize=SIZE, dpi=DOTS_PER_INCH,
                width_ratios=[1.3, 1],
            )  # fmt: skip
            drawn.subplots_adjust(0.05, 0.12, 0.9, 0.84, 0.16, 0.5)
            style.title(axes['map'], found)
            _draw(axes, run, zone, float(time), shapes[i] if shapes else disc(PLATFORM_RADIUS))
            canvas: Any = FigureCanvasAgg(drawn)
            canvas.draw()
            pictures.append(Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3]))
            plt.close(drawn)
    some = np.concatenate([np.asarray(each) for each in pictures[:: max(frames // 6, 1)]])
    palette = Image.fromarray(some).quantize(96, dither=Image.Dither.NONE)
    flat = [each.quantize(palette=palette, dither=Image.Dither.NONE) for each in pictures]
    flat[0].save(
        output, save_all=True, append_images=[*flat[1:], *[flat[-1]] * (frames // 6)],
        duration=EVERY, loop=0, optimize=True,
    )  # fmt: skip


def _draw(axes: dict[str, Any], run: WalkRun, zone: Zone, now: float, shape: Footprint) -> None:
    """Draw all that had happened at one time [s]."""
    row = max(int(np.searchsorted(run.path[:, 0], now, 'right')), 1)
    _draw_map(axes['map'], run, zone, row, now, shape)
    for name, columns, factor in (('flow', run.flow, 1.0), ('speed', run.speeds, 60.0)):
        values = factor * columns[:, 1:]
        style.scale(axes[name], values)
        here = columns[:, 0] <= now
        for i, colour in enumerate((style.ROBOT, style.OTHERS[0], style.PATH)):
            axes[name].plot(columns[here, 0] / 60.0, values[here, i], color=colour, lw=1.2)
            if here.any():
                word = f's{i + 1}' if name == 'flow' else f'turret {i}'
                style.line_label(axes[name], float(values[here, i][-1]), word, colour)
        style.time_axis(axes[name], float(run.path[-1, 0]))
    axes['flow'].set(title='Sap flow', xlabel='')
    axes['flow'].tick_params(labelbottom=False)
    axes['speed'].set(title='Wheels [m/min]')
    label_layout.settle(axes['map'].figure)


def _draw_map(  # noqa: PLR0913, PLR0917 - an instant
    axes: Any, run: WalkRun, zone: Zone, row: int, now: float, shape: Footprint
) -> None:
    style.zone(axes, zone.floor, zone.parts)
    flow = np.interp(run.path[:row, 0], run.flow[:, 0], run.flow[:, 3])
    light = LinearSegmentedColormap.from_list('light', [style.SHADE, style.SUN])
    step = 60
    axes.scatter(
        *run.path[:row:step, 1:3].T, c=flow[::step], s=30, lw=0, cmap=light,
        vmin=run.flow[:, 3].min(), vmax=run.flow[:, 3].max(),
    )  # fmt: skip
    axes.plot(*run.path[:row:10, 1:3].T, color=style.PATH, lw=1.0)
    draw_robot(axes, run.path[row - 1, 1:], shape, strong=True)
    known = int(np.searchsorted(run.goals[:, 0], now, 'right'))
    told = f'{now / 60.0:.0f} min'
    if known:
        _, x, y = run.goals[known - 1]
        style.number(axes, x, y, f'{known}')
        told += (
            f': goal {known}, {run.reasons[known - 1].partition(" at (")[0].partition(": (")[0]}'
        )
    axes.set(xlabel='', ylabel='', xticks=[], yticks=[])
    axes.set_title(told, fontsize=style.TEXT)


if __name__ == '__main__':
    typer.run(main)
