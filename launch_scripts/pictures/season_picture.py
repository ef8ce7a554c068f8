"""Draw how much of its floor one tree stands on in a season: the picture of the README here.

    python launch_scripts/pictures/season_picture.py resource/coverage.png

By memory and the shortest way, against the choice of the original installation, which only went
where it could go straight. Takes some minutes. Each season is kept in a file as it ends:
who asks again waits only for what is not in it. Remove it when the code has changed.
"""

from __future__ import annotations

import itertools
import json
import multiprocessing
from pathlib import Path
from typing import Annotated

import typer

from agv_motion.files.unfinished import replacing
from agv_motion.report.season_figure import FloorCoverage, draw
from agv_motion.simulation.trials.season import Season, SeasonParameters

KINDS, STRATEGIES = ('square', 'garden', 'rooms'), ('memory', 'straight')


def spend(given: SeasonParameters) -> tuple[SeasonParameters, list[float]]:
    """Return a season, and the share of the floor stood on when it begins and after each day."""
    return given, [0.0, *Season(given).run().coverage]


def main(
    output: Annotated[Path, typer.Argument(help='Picture.')] = Path('coverage.png'),
    *,
    seasons: Annotated[Path, typer.Option(help='Where seasons are kept.')] = Path('season.json'),
    each: Annotated[int, typer.Option(help='Seasons of each kind.', min=1)] = 3,
    days: Annotated[int, typer.Option(help='Days of a season.', min=1)] = 12,
    dark: Annotated[bool, typer.Option('--dark', help='Light on dark.')] = False,
) -> None:
    """Play the seasons that are not kept yet, and draw all."""
    wanted = {
        f'{kind}, {strategy}, {days} days, seed {number}': SeasonParameters(
            kind=kind, trees=1, days=days, seed=number, strategy=strategy
        )
        for number, kind, strategy in itertools.product(range(1, each + 1), KINDS, STRATEGIES)
    }
    kept: dict[str, list[float]] = json.loads(seasons.read_text()) if seasons.exists() else {}
    names = {given: name for name, given in wanted.items() if name not in kept}
    with multiprocessing.Pool() as pool:
        for left, (given, coverage) in zip(
            reversed(range(len(names))), pool.imap_unordered(spend, names), strict=True
        ):
            kept[names[given]] = coverage
            with replacing(seasons) as path:
                path.write_text(json.dumps(kept, indent=1))
            typer.echo(f'{names[given]}: {100.0 * coverage[-1]:.0f} % of the floor; {left} to go')
    floors = {
        kind: FloorCoverage(
            *(
                [kept[name] for name, one in wanted.items() if (one.kind, one.strategy) == both]
                for both in itertools.product((kind,), STRATEGIES)
            )
        )
        for kind in KINDS
    }
    draw(floors, output, theme='dark' if dark else 'light')
    typer.echo(f'Coverage: {output}')


if __name__ == '__main__':
    typer.run(main)
