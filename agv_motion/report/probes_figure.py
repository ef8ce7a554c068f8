"""Probes in a file as the package reads them: signal, zero flow, flow index, flux, sap flow."""

from __future__ import annotations

from datetime import datetime, timezone
from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.report import style
from agv_motion.report.figure import figure

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from agv_motion.probe.series import ProbeSeries

DAY = 86400.0
MOST_COLUMNS = 3
"""Probes beside each other; the first ones of a file with more."""
MICROMETRES = 1e6
PANELS = {
    'signal': 'dT [K]', 'index': 'flow index K [-]', 'flux': 'flux density [µm/s]',
    'flow': 'sap flow [-]',
}  # fmt: skip


def draw(names: Sequence[str], probes: Sequence[ProbeSeries], path: Path, theme: str) -> None:
    """Draw what is known of each probe, from its signal at the top to its sap flow.

    Args:
        names: Of the probes.
        probes: Their series, of the same readings.
        path: Of the picture.
        theme: `light` or `dark`.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    shown = list(zip(names, probes, strict=True))[:MOST_COLUMNS]
    mosaic = [[f'{panel}{i}' for i in range(len(shown))] for panel in PANELS]
    size = style.WIDTH, 9.0
    with figure(path, mosaic, theme=theme, figsize=size, sharex=True) as axes:
        for i, (name, series) in enumerate(shown):
            _column({panel: axes[f'{panel}{i}'] for panel in PANELS}, name, series)
        for panel, label in PANELS.items():
            axes[f'{panel}0'].set_ylabel(label)
            for i in range(1, len(shown)):
                axes[f'{panel}{i}'].sharey(axes[f'{panel}0'])
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
    since = datetime.fromtimestamp(series.time[0], timezone.utc)
    axes['flow'].set_xlabel(f'days since {since:%Y-%m-%d %H:%M} UTC')


def _line(axes: Any, days: Any, values: Any, color: Any) -> None:
    axes.plot(*style.thinned(days, values), color=color, lw=0.9)


def _last(values: Any) -> float:
    told = values[np.isfinite(values)]
    return float(told[-1]) if len(told) else np.nan
