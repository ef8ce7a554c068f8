"""`agv bag errors`: how far what a robot told is from a reference, with the numbers of evo."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple, TypeVar

import typer

from agv_motion.cli.bag.options import opened
from agv_motion.cli.terminal import LineTable, terminal
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Mapping
    from enum import Enum

    from agv_motion.bag.reader import BagReader
    from agv_motion.report.trajectory_errors import ComparisonRequest, Delta, TrajectoryComparison

    Choice = TypeVar('Choice', bound=Enum)
    Value = TypeVar('Value')


Metric = Annotated[str, typer.Option(help='ape: poses; rpe: ways between poses.')]
Relations = Annotated[
    list[str] | None,
    typer.Option(
        '--relation',
        help='translation [m], rotation [deg] or full [-]; one per option. Else the first two.',
    ),
]
Align = Annotated[str, typer.Option(help='none, origin, or se2 or se3 by Umeyama (least squares).')]
Scale = Annotated[bool, typer.Option('--scale', help='Fit the scale too, of se2 and se3.')]
Size = Annotated[float, typer.Option(help='How far apart the two poses of rpe are.')]
Unit = Annotated[str, typer.Option(help='Of --delta: frames, metres or seconds.')]
AllPairs = Annotated[
    bool, typer.Option('--all-pairs', help='rpe from every pose on, not end to end.')
]
Tolerance = Annotated[
    float, typer.Option(help='By which share of --delta one of all pairs may be off.')
]
Within = Annotated[
    float, typer.Option(help='Seconds by which two poses that are compared may be apart.')
]
Offset = Annotated[
    float, typer.Option(help='Seconds added to the stamps of --driven: its clock was behind.')
]


def errors(
    bag: Annotated[Path, typer.Argument(help='Bag of the run: its folder, or one file.')],
    *,
    reference: Annotated[str, typer.Option(help='Topic that tells where the robot really was.')],
    driven: Annotated[
        list[str] | None,
        typer.Option(help='Topic to judge; one per option. Else pose, odom, ... as in agv plot.'),
    ] = None,
    run: Annotated[
        list[Path] | None, typer.Option(help='One more bag to judge; one per option.')
    ] = None,
    reference_bag: Annotated[
        Path | None, typer.Option(help='Bag with the reference of all runs; else each its own.')
    ] = None,
    metric: Metric = 'ape',
    relations: Relations = None,
    align: Align = 'none',
    scale: Scale = False,
    delta: Size = 1.0,
    unit: Unit = 'frames',
    all_pairs: AllPairs = False,
    tolerance: Tolerance = 0.1,
    within: Within = 0.01,
    offset: Offset = 0.0,
    as_json: Annotated[bool, typer.Option('--json', help='For other programs.')] = False,
    plot: Annotated[Path | None, typer.Option(help='Picture to draw.')] = None,
) -> None:
    """Tell how far poses are from a reference: absolute (APE) or relative (RPE), as evo does.

    Each pose gets the nearest in time, by the stamps of the headers; nothing is interpolated. The
    absolute error is how far the pose is off; the relative one how far off the robot goes within
    --delta, which neither the choice of the frame nor an early error spoils. Topics of different
    frames are compared after --align only, or by rpe. Examples:

    agv bag errors walk --reference /ground_truth --driven /pose

    agv bag errors walk --reference /ground_truth --driven /odom --align se2 --plot odom.png

    agv bag errors walk --reference /ground_truth --metric rpe --delta 1 --unit metres --all-pairs

    agv bag errors monday --run tuesday --run friday --reference /ground_truth --json

    agv bag errors reprocessed --reference /ground_truth --reference-bag walk --driven /pose
    """
    between = _relative(metric, delta, unit, all_pairs=all_pairs, tolerance=tolerance)
    request = _request(between, relations, align, scaled=scale)._replace(
        within=within, offset=offset
    )
    with ExitStack() as stack:
        readers = [stack.enter_context(opened(path)) for path in [bag, *(run or [])]]
        other = stack.enter_context(opened(reference_bag)) if reference_bag else None
        judged = _judged(readers, other, reference, driven or [], request)
        if plot is not None:
            _draw(judged, plot)
        if as_json:
            _encode(judged, metric, request)
        else:
            terminal().print(_table(judged, metric))
            if plot is not None:
                typer.echo(f'Figure: {plot}')


class Judged(NamedTuple):
    """One topic of one bag."""

    bag: str
    comparison: TrajectoryComparison


def _words(choices: type[Choice]) -> dict[str, Choice]:
    return {one.value: one for one in choices}


def _chosen(option: str, choices: Mapping[str, Value], word: str) -> Value:
    if word not in choices:
        msg = f"{option} '{word}': choose one of {', '.join(choices)}"
        raise ConfigurationError(msg)
    return choices[word]


def _relative(
    metric: str, delta: float, unit: str, *, all_pairs: bool, tolerance: float
) -> Delta | None:
    """Return between which poses the relative error is taken; None: absolute errors."""
    from agv_motion.report.trajectory_errors import Delta, DeltaUnit

    between = Delta(delta, _chosen('--unit', _words(DeltaUnit), unit), all_pairs, tolerance)
    return _chosen('--metric', {'ape': None, 'rpe': between}, metric)


def _request(
    between: Delta | None, relations: list[str] | None, align: str, *, scaled: bool
) -> ComparisonRequest:
    from agv_motion.report.trajectory_alignment import Alignment
    from agv_motion.report.trajectory_errors import ComparisonRequest, Relation

    words = _words(Relation)
    wanted = [_chosen('--relation', words, one) for one in relations or list(words)[:2]]
    alignment = _chosen('--align', _words(Alignment), align)
    return ComparisonRequest(
        alignment=alignment, scaled=scaled, delta=between, relations=tuple(dict.fromkeys(wanted))
    )


def _judged(
    bags: list[BagReader],
    other: BagReader | None,
    reference: str,
    topics: list[str],
    request: ComparisonRequest,
) -> list[Judged]:
    """Compare the topics of each bag, or the one that `agv plot` would take, with its reference."""
    from agv_motion.report.pose_topics import driven_beside, read_poses
    from agv_motion.report.trajectory_errors import compare

    given = None if other is None else read_poses(other, reference)
    judged = []
    for bag in bags:
        truth = read_poses(bag, reference) if given is None else given
        told = [read_poses(bag, topic) for topic in topics] or [driven_beside(bag, truth)]
        judged += [Judged(str(bag.path), compare(truth, poses, request)) for poses in told]
    return judged


def _draw(judged: list[Judged], path: Path) -> None:
    from agv_motion.report.trajectory_errors_figure import draw

    several = len({one.bag for one in judged}) > 1
    draw(
        [
            (f'{one.bag} {one.comparison.driven.name}' if several else one.comparison.driven.name,
             one.comparison)
            for one in judged
        ],
        path,
    )  # fmt: skip


def _table(judged: list[Judged], metric: str) -> LineTable:
    """Return a row for each relation of each topic of each bag, the relations together."""
    from agv_motion.report.trajectory_errors import ErrorStatistics, statistics

    table = LineTable()
    left = ('bag', 'topic', 'error')
    for title in (*left, 'n', *ErrorStatistics._fields):
        table.add_column(title, justify='left' if title in left else 'right', overflow='fold')
    for relation in judged[0].comparison.errors:
        unit = f' [{relation.unit}]' if relation.unit else ''
        for bag, comparison in judged:
            found = comparison.errors[relation]
            table.add_row(
                bag, comparison.driven.name, f'{metric} {relation.value}{unit}', str(len(found)),
                *(f'{value:.6g}' for value in statistics(found)),
            )  # fmt: skip
    return table


def _encode(judged: list[Judged], metric: str, request: ComparisonRequest) -> None:
    """Print all that the table says in full precision, and how each was laid over its reference."""
    import json

    from agv_motion.report.trajectory_errors import statistics

    delta = request.delta and request.delta._replace(unit=request.delta.unit.value)  # type: ignore[arg-type] # for JSON
    runs = [
        {
            'bag': bag,
            'reference': one.reference.name,
            'driven': one.driven.name,
            'poses': len(one.driven.stamp),
            'alignment': {
                'rotation': one.similarity.rotation.tolist(),
                'translation': one.similarity.translation.tolist(),
                'scale': one.similarity.scale,
            },
            'errors': {
                relation.value: {'unit': relation.unit, 'n': len(found)}
                | statistics(found)._asdict()
                for relation, found in one.errors.items()
            },
        }
        for bag, one in judged
    ]
    head = {
        'metric': metric, 'align': request.alignment.value, 'scaled': request.scaled,
        'within': request.within, 'offset': request.offset,
        'delta': delta and delta._asdict(),
    }  # fmt: skip
    typer.echo(json.dumps(head | {'runs': runs}, indent=2, allow_nan=False))
