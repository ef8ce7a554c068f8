"""Draw the scene in the bag of a demo as RViz and Foxglove show it: the one in the README.

launch_scripts/demo
python launch_scripts/pictures/scene_picture.py demo_output/bag -o resource/scene.png --at 500
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from agv_motion.bag.reader import BagReader
from agv_motion.report.scene_figure import draw, read_scene


def main(
    bag: Annotated[Path, typer.Argument(help='Bag of a demo.')],
    output: Annotated[Path, typer.Option('--output', '-o', help='Picture.')] = Path('scene.png'),
    *,
    at: Annotated[float, typer.Option(help='Seconds since the start of the bag.')] = 300.0,
    dark: Annotated[bool, typer.Option('--dark', help='Light on dark.')] = False,
) -> None:
    """Draw the markers and the robots of a bag as they are at an instant."""
    with BagReader(bag) as reader:
        scene = read_scene(reader, at)
    draw(scene, TITLE, output, theme='dark' if dark else 'light')
    typer.echo(f'Scene: {output}, {len(scene.markers)} markers')


TITLE = 'The scene as RViz, Foxglove and Lichtblick show it'


if __name__ == '__main__':
    typer.run(main)
