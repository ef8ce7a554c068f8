"""One hand for all figures: colours with one meaning each, sizes, labels at the lines, events.

Whatever is placed over data is moved apart by `label_layout.settle`, once the layout is known:
labels at the ends of lines downwards and upwards, events into rows above the axes.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.report.label_layout import END, EVENT, NAME, ROOMS
from agv_motion.report.wording import sentence

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike, NDArray

ROBOT = '#0072B2'
"""Blue of Okabe and Ito, as all colours here: they stay apart for every eye."""
GOAL = '#D55E00'
PATH = '#009E73'
OTHERS = ('#CC79A7', '#8C8C8C', '#7B5EA7', '#B0A0B8')
"""Of other robots, and of what is not the robot's own."""
SUN, SHADE = '#F0C80F', '#7488A0'
HINDERED, WAITING = '#E69F00', '#56B4E9'
"""Where a robot gives way, or something holds it down; where it waits."""
LINES = (ROBOT, '#CC79A7', PATH, '#E69F00', '#56B4E9', GOAL, '#8C8C8C')
"""Of fields without a meaning of their own."""

TITLE, TEXT, SMALL = 13.0, 9.0, 8.0
"""[pt] The typographic scale, on pictures 10 inches wide."""

WIDTH = 10.0
"""[in]"""

MOST_TOGETHER = 4
"""Numbers that stand in one disc"""

MOST_POINTS = 5000
"""of a line: what is longer is thinned by its envelope."""

INKS = {'light': ('#1A1A1A', '#6B6B6B', '#FFFFFF'), 'dark': ('#EDEDED', '#A0A0A0', '#16191D')}
"""Ink, faint ink and paper of each theme."""


def settings(theme: str = 'light') -> Any:
    """Return the settings of matplotlib for a theme, ``light`` or ``dark``."""
    ink, faint, paper = INKS[theme]
    return {
        'font.size': TEXT, 'axes.labelsize': TEXT, 'axes.titlesize': TEXT,
        'axes.formatter.useoffset': False,
        'axes.titleweight': 'bold', 'axes.titlelocation': 'left', 'figure.titlesize': TITLE,
        'figure.titleweight': 'bold', 'xtick.labelsize': SMALL, 'ytick.labelsize': SMALL,
        'legend.fontsize': SMALL, 'legend.frameon': False, 'axes.spines.top': False,
        'axes.spines.right': False, 'axes.edgecolor': faint, 'axes.labelcolor': ink,
        'xtick.color': faint, 'ytick.color': faint, 'xtick.labelcolor': ink,
        'ytick.labelcolor': ink, 'text.color': ink, 'figure.facecolor': paper,
        'axes.facecolor': paper, 'savefig.facecolor': paper, 'lines.linewidth': 1.3,
        'lines.solid_capstyle': 'round', 'grid.color': faint, 'grid.alpha': 0.25,
        'grid.linewidth': 0.6, 'figure.constrained_layout.h_pad': 0.08, 'svg.fonttype': 'none',
    }  # fmt: skip


def ink() -> Any:
    """Return the colour of text and limits in the theme in force."""
    import matplotlib as mpl

    return mpl.rcParams['text.color']


def faint() -> Any:
    """Return the colour of what stands back in the theme in force."""
    import matplotlib as mpl

    return mpl.rcParams['xtick.color']


def paper() -> Any:
    """Return the colour of the ground in the theme in force."""
    import matplotlib as mpl

    return mpl.rcParams['axes.facecolor']


def title(axes: Axes, finding: str, beside: str = '') -> None:
    """Write the finding over the whole picture, at its left, and what is to be known below it."""
    figure = axes.figure
    figure.suptitle(sentence(finding), x=0.01, ha='left', fontsize=TITLE)
    if beside:
        figure.supxlabel(beside, x=0.01, ha='left', fontsize=SMALL, color=faint())


def line_label(axes: Axes, y: float, text: str, color: Any) -> None:
    """Name a line at its end, right of the axes, at the height ``y`` of its last value."""
    if np.isfinite(y):
        axes.annotate(
            text, (1.0, y), xycoords=axes.get_yaxis_transform(), xytext=(5, 0),
            textcoords='offset points', va='center', color=color, fontsize=SMALL, gid=END,
            annotation_clip=False,
        )  # fmt: skip


def event(axes: Axes, x: float, text: str, *, also: Iterable[Axes] = ()) -> None:
    """Name what happened at ``x``: a thin line through the axes, and the words above them."""
    for each in (axes, *also):
        each.axvline(x, color=faint(), lw=0.8, ls=(0, (2, 2)), zorder=0.5)
    axes.annotate(
        text, (x, 1.0), xycoords=axes.get_xaxis_transform(), xytext=(0, 4), fontsize=SMALL,
        textcoords='offset points', va='bottom', ha='left', gid=EVENT, annotation_clip=False,
    )  # fmt: skip


def limit(axes: Axes, value: float, text: str) -> None:
    """Draw a limit, in dashes and with its name; only what the axes can show."""
    axes.axhline(value, color=ink(), ls=(0, (5, 3)), lw=1.0)
    line_label(axes, value, text, ink())


def scale(axes: Axes, *values: ArrayLike, least: float = 0.0) -> None:
    """Let the axes hold the data and a little room, over at least ``least``."""
    finite = np.concatenate([np.ravel(np.asarray(v, dtype=float)) for v in values])
    finite = finite[np.isfinite(finite)]
    if len(finite):
        low, high = float(finite.min()), float(finite.max())
        room = max(0.08 * (high - low), 0.5 * (least - (high - low)), 1e-9)
        axes.set_ylim(low - room, high + room)


def direction(axes: Axes, way: NDArray[np.float64], color: Any, times: int = 4) -> None:
    """Put arrow heads on a way, (n, 2), evenly along its length."""
    moved = np.hypot(*np.diff(way, axis=0).T)
    length = np.concatenate([[0.0], np.cumsum(np.where(np.isfinite(moved), moved, 0.0))])
    if length[-1] <= 0.0:
        return
    for share in (np.arange(times) + 0.5) / times:
        at = int(np.clip(np.searchsorted(length, share * length[-1]), 1, len(way) - 1))
        before = int(np.searchsorted(length, max(length[at] - 0.02 * length[-1], 0.0)))
        axes.annotate(
            '', way[at], way[min(before, at - 1)],
            arrowprops={'arrowstyle': '-|>', 'color': color, 'lw': 0.0, 'mutation_scale': 11},
        )  # fmt: skip


def number(axes: Axes, x: float, y: float, text: str, color: Any = GOAL) -> None:
    """Put a numbered disc at a place."""
    shape = 'circle,pad=0.22' if len(text) < 3 else 'round,pad=0.25,rounding_size=0.8'
    axes.text(
        x, y, text, color='white', fontsize=SMALL - 1.0, fontweight='bold', ha='center',
        va='center', bbox={'boxstyle': shape, 'facecolor': color, 'edgecolor': 'none'}, zorder=6,
        clip_on=False,
    )  # fmt: skip


def grouped(
    places: Iterable[Sequence[float]], distance: float, first: int = 0
) -> list[tuple[float, float, str]]:
    """Return places, x and y, with their numbers from 1 on; the nearer ones share one.

    Of more than `MOST_TOGETHER` at one place the first and the last two are told; those before
    ``first``, counted from 0, are left out.
    """
    found: list[tuple[float, float, list[int]]] = []
    for i, (x, y) in enumerate(places):
        if i < first:
            continue
        near = next((at for at in found if np.hypot(at[0] - x, at[1] - y) < distance), None)
        if near is None:
            found.append((x, y, [i + 1]))
        else:
            near[2].append(i + 1)
    return [(x, y, _together(numbers)) for x, y, numbers in found]


def _together(numbers: list[int]) -> str:
    words = [f'{number}' for number in numbers]
    if len(words) > MOST_TOGETHER:
        words = [words[0], '…', *words[-2:]]
    return '\u2009·\u2009'.join(words)


def name_near(  # noqa: PLR0913, PLR0917 - a word on a map
    axes: Axes, centre: ArrayLike, distance: float, name: str, color: Any, taken: list[Any]
) -> None:
    """Write a bold name near a place, where most room is, and count it among what is ``taken``.

    Args:
        axes: A map.
        centre: x and y of the place.
        distance: Of the name from it, in the unit of the map.
        name: What to write.
        color: Of the name.
        taken: Places, x and y, where something is drawn.

    """
    angles = np.arange(16) * np.pi / 8.0
    ways = np.array([np.cos(angles), np.sin(angles)]).T
    around = np.asarray(centre, dtype=float) + distance * ways
    gaps = np.hypot(*(around[:, None, :] - np.asarray(taken)[None, :, :]).transpose(2, 0, 1))
    order = np.argsort(-gaps.min(axis=1), kind='stable')
    first = around[order[0]].tolist()
    text = axes.text(
        first[0], first[1], name, color=color, fontweight='bold', fontsize=SMALL, va='center',
        ha='center', zorder=7, gid=NAME,
        bbox={'facecolor': paper(), 'edgecolor': 'none', 'alpha': 0.7, 'pad': 0.6},
    )  # fmt: skip
    places = np.concatenate([around[order], around[order] + 0.8 * distance * ways[order]])
    sides = [_side(float(ways[i, 0])) for i in order]
    ROOMS[text] = [(*at.tolist(), side) for at, side in zip(places, sides * 2, strict=True)]
    taken.append(np.array(first))


def _side(aside: float) -> str:
    return 'left' if aside > 0.3 else 'right' if aside < -0.3 else 'center'


def zone(axes: Axes, floor: Any, parts: Sequence[Any] = ()) -> None:
    """Draw the edge of a floor, and in dashes how far the centre of a robot may go."""
    for ring in (floor.exterior, *floor.interiors):
        axes.plot(*np.array(ring.coords).T, color=ink(), lw=1.4)
    for part in parts:
        for ring in (part.exterior, *part.interiors):
            axes.plot(*np.array(ring.coords).T, color=ink(), lw=0.9, ls=(0, (5, 3)))
    west, south, east, north = floor.bounds
    axes.set(
        aspect='equal', xlabel='x [m]', ylabel='y [m]', xlim=(west - 0.3, east + 0.3),
        ylim=(south - 0.3, north + 0.3),
    )  # fmt: skip
    axes.spines[:].set_visible(False)
    axes.set_anchor('N')


def frame(axes: Axes, places: ArrayLike, room: float) -> None:
    """Let a map hold all ``places``, (n, 2) with NaN between, and ``room`` [m] around them."""
    known = np.asarray(places, dtype=float)
    known = known[np.isfinite(known).all(axis=1)]
    if len(known):
        (west, south), (east, north) = known.min(axis=0) - room, known.max(axis=0) + room
        axes.set(xlim=(west, east), ylim=(south, north))
    axes.set(aspect='equal', xlabel='x [m]', ylabel='y [m]')


def broken(time: ArrayLike, values: ArrayLike, least: float = 0.0) -> tuple[Any, Any]:
    """Return a line that is not joined over silences: NaN in each.

    Args:
        time: (n,) [s].
        values: (n,) or (n, m), over time.
        least: [s] A silence is longer than that, and than ten times the usual step.

    """
    x, y = np.asarray(time, dtype=float), np.asarray(values, dtype=float)
    steps = np.diff(x)
    longest = max(least, 10.0 * float(np.median(steps))) if len(steps) else least
    gaps = np.flatnonzero(steps > longest) + 1
    return np.insert(x, gaps, np.nan), np.insert(y, gaps, np.nan, axis=0)


def time_unit(seconds: float) -> tuple[float, str]:
    """Return the unit [s] in which a length of time is told on an axis, and the words there."""
    if seconds <= 600.0:
        return 1.0, 'time [s]'
    if seconds <= 3.0 * 3600.0:
        return 60.0, 'time [min]'
    return (3600.0, 'time [h]') if seconds <= 3.0 * 86400.0 else (86400.0, 'time [days]')


def time_axis(axes: Axes, seconds: float, days: float = 0.0) -> Callable[[ArrayLike], Any]:
    """Write the time on an axis in the unit that fits, and return how to turn seconds into it.

    Args:
        axes: The lowest of those that share the axis.
        seconds: How long it all took [s].
        days: How many days of a recording were played meanwhile; 0: none.

    """
    unit, name = (seconds / days, 'day of the recording') if days else time_unit(seconds)
    axes.set(xlabel=name, xlim=(0.0, (seconds or 1.0) / unit))
    return lambda values: np.asarray(values, dtype=float) / unit


def thinned(time: ArrayLike, values: ArrayLike) -> tuple[Any, Any]:
    """Return a line of at most `MOST_POINTS`: the least and the greatest of each stretch."""
    x, y = np.asarray(time, dtype=float), np.asarray(values, dtype=float)
    if len(x) <= MOST_POINTS:
        return x, y
    starts = np.linspace(0, len(x), MOST_POINTS // 2 + 1).astype(int)
    picked = set()
    for begin, end in pairwise(starts):
        part = y[begin:end]
        if np.isnan(part).all():
            picked.add(begin)
        else:
            picked |= {begin + int(np.nanargmin(part)), begin + int(np.nanargmax(part))}
    kept = np.array(sorted(picked))
    return x[kept], y[kept]
