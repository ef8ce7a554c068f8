"""Probes in a file as the package reads them: signal, zero flow, flow index, flux, sap flow."""

from __future__ import annotations

from datetime import datetime, timezone
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.report import style
from agv_motion.report.figure import figure
from agv_motion.report.litres import in_litres

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from agv_motion.probe.series import ProbeSeries
    from agv_motion.probe.water import DayOfWater

DAY = 86400.0
MOST_COLUMNS = 3
"""Probes beside each other; the first ones of a file with more."""
MICROMETRES = 1e6
PANELS = {
    'signal': 'dT [K]', 'index': 'flow index K [-]', 'flux': 'flux density [µm/s]',
    'flow': 'sap flow [-]',
}  # fmt: skip


WHOLE = 0.9
"""Share of a day whose flow is known, from which on it counts as a whole one."""


class PlaceDays(NamedTuple):
    """What a tree drank, by the days of its place."""

    days: Sequence[DayOfWater]
    offset: float
    """Local solar time minus UTC [h]"""


def draw(
    names: Sequence[str],
    probes: Sequence[ProbeSeries],
    path: Path,
    theme: str,
    water: PlaceDays | None = None,
) -> None:
    """Draw what is known of each probe, from its signal at the top to its sap flow.

    Args:
        names: Of the probes.
        probes: Their series, of the same readings.
        path: Of the picture.
        theme: `light` or `dark`.
        water: What the tree drank; None where its sapwood is not known.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    shown = list(zip(names, probes, strict=True))[:MOST_COLUMNS]
    mosaic = [[f'{panel}{i}' for i in range(len(shown))] for panel in PANELS]
    mosaic += [['water'] * len(shown)] if water else []
    size = style.WIDTH, 10.8 if water else 9.0
    with figure(path, mosaic, theme=theme, figsize=size, sharex=True) as axes:
        for i, (name, series) in enumerate(shown):
            _column({panel: axes[f'{panel}{i}'] for panel in PANELS}, name, series)
        for panel, label in PANELS.items():
            axes[f'{panel}0'].set_ylabel(label)
            for i in range(1, len(shown)):
                axes[f'{panel}{i}'].sharey(axes[f'{panel}0'])
        if water:
            _draw_water(axes['water'], water, probes[0].time[0])
        since = datetime.fromtimestamp(probes[0].time[0], timezone.utc)
        for lowest in [axes['water']] if water else [axes[f'flow{i}'] for i in range(len(shown))]:
            lowest.set_xlabel(f'days since {since:%Y-%m-%d %H:%M} UTC')
        style.title(axes['signal0'], finding(names, probes))


def finding(names: Sequence[str], probes: Sequence[ProbeSeries]) -> str:
    """Return in a sentence how much of the readings can be believed, and what they tell."""
    usable = [np.mean([q.usable for q in series.quality]) for series in probes]
    flows = np.concatenate([series.sap_flow for series in probes])
    days = (probes[0].time[-1] - probes[0].time[0]) / DAY
    told = f'{100.0 * np.mean(usable):.0f} % of the readings of {len(names)} probes'
    if len(names) == 1:
        told = f'{100.0 * usable[0]:.0f} % of the readings of {names[0]}'
    told = f'{told} believed in {days:.0f} days'
    if not np.isfinite(flows).any():
        return f'{told}, no sap flow known yet'
    return f'{told}, sap flow {float(np.nanmean(flows)):.2f} of the fullest'


def _column(axes: dict[str, Any], name: str, series: ProbeSeries) -> None:
    days = (series.time - series.time[0]) / DAY
    usable = np.array([quality.usable for quality in series.quality])
    signal = axes['signal']
    signal.set_title(name)
    _line(signal, days, np.where(usable, series.temperature_difference, np.nan), style.ROBOT)
    _line(signal, days, series.zero_flow, style.GOAL)
    style.line_label(signal, _last(series.zero_flow), 'zero flow', style.GOAL)
    wrong = ~usable & np.isfinite(series.temperature_difference)
    signal.plot(
        days[wrong],
        series.temperature_difference[wrong],
        ls='',
        marker='x',
        ms=3,
        color=style.faint(),
    )
    style.scale(signal, series.temperature_difference[usable], series.zero_flow)
    _line(axes['index'], days, series.flow_index, style.PATH)
    _line(axes['flux'], days, MICROMETRES * series.flux_density, style.PATH)
    _line(axes['flow'], days, series.sap_flow, style.ROBOT)
    axes['flow'].set(ylim=(-0.03, 1.03))


def _draw_water(axes: Any, water: PlaceDays, start: float) -> None:
    """Draw a bar a day with its interval; one of which much is unknown stands back."""
    days = [day for day in water.days if day.drunk.high > 0.0]
    begins = np.array([(day.day * DAY - 3600.0 * water.offset - start) / DAY for day in days])
    value, low, high = np.array([day.drunk for day in days], float).reshape(-1, 3).T
    whole = [day.known >= WHOLE for day in days]
    colours = [style.ROBOT if each else style.faint() for each in whole]
    axes.bar(begins, value, width=0.9, align='edge', color=colours, alpha=0.7)
    axes.vlines(begins + 0.45, low, high, color=style.ink(), lw=0.9)
    full = sorted(day.drunk for day, each in zip(days, whole, strict=True) if each)
    usual = f': {in_litres(full[len(full) // 2])} on a usual day' if full else ''
    axes.set(title=f'Water, with 95 % confidence{usual}', ylabel='water [L/day]')
    axes.set_ylim(0.0, None)


def _line(axes: Any, days: Any, values: Any, color: Any) -> None:
    axes.plot(*style.thinned(days, values), color=color, lw=0.9)


def _last(values: Any) -> float:
    told = values[np.isfinite(values)]
    return float(told[-1]) if len(told) else np.nan
