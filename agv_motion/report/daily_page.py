"""The report of a day: one HTML file that needs nothing else, for a phone as for a desk."""

from __future__ import annotations

from datetime import datetime, timezone
from html import escape
from typing import TYPE_CHECKING
from zoneinfo import ZoneInfo

from agv_motion.explanation.words import ago
from agv_motion.report.daily_drawing import COLOURS, OTHER, bar_of, map_of
from agv_motion.report.litres import in_litres

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from pathlib import Path

    from agv_motion.dashboard.core.alerts import Alert
    from agv_motion.report.daily import Day
    from agv_motion.report.daily_robot import ProbeDay, RobotDay, Span

STYLE = """
:root { color-scheme: light; }
body { font: 16px/1.45 system-ui, sans-serif; margin: 0 auto; max-width: 60rem; padding: 0 1rem 3rem; color: #111; background: #fff; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.3rem; border-top: 2px solid #333; padding-top: .6rem; }
h3 { font-size: 1.05rem; margin-bottom: .3rem; }
svg { width: 100%; height: auto; max-height: 80vh; } svg.bar { height: 2.2rem; }
table { border-collapse: collapse; width: 100%; font-size: .92rem; }
th, td { text-align: left; padding: .25rem .5rem .25rem 0; border-bottom: 1px solid #ddd; vertical-align: top; overflow-wrap: break-word; }
th { white-space: nowrap; }
.wide { overflow-x: auto; } .key span { display: inline-block; margin-right: .9rem; }
.key i { display: inline-block; width: .9em; height: .9em; margin-right: .3em; border: 1px solid #333; }
p.note { color: #444; font-size: .9rem; }
"""  # noqa: E501 - a rule a line

POLICY = "default-src 'none'; style-src 'unsafe-inline'"
"""The page loads nothing, and runs nothing."""

MAP = 'Blue: its way, from the ring to the disc. Numbers: goals, in turn.'

REST = 60.0
"""[s] A shorter time without motion is no rest worth a row."""

MOST_ROWS = 60
"""of a table; the longest rests, and the latest alerts"""

NO_NUMBER = 'no number'


def page(day: Day, sources: Sequence[Path], time_zone: str = 'UTC') -> str:
    """Return the report as HTML.

    Args:
        day: What was read.
        sources: The bags of it, for whoever asks where it comes from.
        time_zone: IANA name, in which times are told.

    """
    zone = ZoneInfo(time_zone)
    title = f'{_local(day.begin, zone):%A, %d %B %Y}'
    body = ''.join(_robot(robot, day, zone) for robot in day.robots)
    names = ', '.join(escape(str(source)) for source in sources)
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        f'<meta http-equiv="Content-Security-Policy" content="{escape(POLICY)}">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f'<title>{escape(title)}</title><style>{STYLE}</style></head><body>\n'
        f'<h1>{escape(title)}</h1>\n<p>{_clock(day.begin, zone)} to {_clock(day.end, zone)} '
        f'({escape(time_zone)}), {len(day.robots)} robot{"s" * (len(day.robots) != 1)}</p>\n'
        f'{body}<p class="note">From {names}</p>\n</body></html>\n'
    )


def _robot(robot: RobotDay, day: Day, zone: ZoneInfo) -> str:
    drawing = map_of(robot)
    parts = [
        f'<section><h2>{escape(robot.name)}</h2>\n{_summary(robot)}',
        f'<h3>Where it went</h3>{drawing}<p class="note">{MAP}</p>'
        if drawing
        else '<p>Nobody told where it was.</p>',
        _activities(robot, day),
        _rests(robot, zone),
        _drivers(robot),
        _alerts(robot, zone),
        _probes(robot),
    ]
    return '\n'.join(part for part in parts if part) + '</section>\n'


def _summary(robot: RobotDay) -> str:
    count = len(robot.goals)
    goals = f'{count} goal' + 's' * (count != 1)
    sentences = [f'It went <b>{robot.walked:.1f} m</b>, for {goals}.']
    litres, drunk = robot.litres.total(), robot.drunk()
    if litres is not None:
        sentences.append(f'It drank <b>{in_litres(litres)} of water</b>, with 95 % confidence.')
    if drunk is not None:
        sentences.append(
            f'It drank <b>{1000.0 * drunk:.1f} litres of water per square metre of sapwood</b>.'
        )
    totals = robot.doing.totals()
    if totals:
        told = ', '.join(f'{escape(word)} {ago(seconds)}' for word, seconds in totals.items())
        sentences.append(f'It was {told}.')
    if robot.no_numbers:
        sentences.append(f'{robot.no_numbers} of its places or amounts held {NO_NUMBER}.')
    return f'<p>{" ".join(sentences)}</p>'


def _activities(robot: RobotDay, day: Day) -> str:
    bar = bar_of(robot, day.begin, day.end)
    if not bar:
        return ''
    keys = ''.join(
        f'<span><i style="background:{COLOURS.get(word, OTHER)}"></i>{escape(word)}</span>'
        for word in robot.doing.totals()
    )
    return f'<h3>What it did</h3>{bar}<p class="key">{keys}</p>'


def _rests(robot: RobotDay, zone: ZoneInfo) -> str:
    """Return when it stood and why: the longest, in the order of time."""
    moving = {'walking', 'driving', 'turning'}
    found = [s for s in robot.doing.spans if s.activity not in moving and s.duration >= REST]
    longest = sorted(sorted(found, key=lambda s: -s.duration)[:MOST_ROWS])
    rows = (_span_row(span, zone) for span in longest)
    more = len(found) - len(longest)
    note = f'<p class="note">and {more} shorter ones</p>' if more else ''
    table = _table(('from', 'to', 'for', 'it was', 'why'), rows)
    return f'<h3>Rests, and why</h3>{table or "<p>None of a minute.</p>"}{note}'


def _span_row(span: Span, zone: ZoneInfo) -> tuple[str, ...]:
    begin, end = _clock(span.begin, zone), _clock(span.end, zone)
    return begin, end, ago(span.duration), span.activity, span.sentence


def _drivers(robot: RobotDay) -> str:
    totals = robot.drivers.totals()
    rows = ((who or 'nobody', ago(seconds)) for who, seconds in totals.items())
    table = _table(('who', 'for'), rows)
    return f'<h3>Who drove</h3>{table}' if table else ''


def _alerts(robot: RobotDay, zone: ZoneInfo) -> str:
    if not robot.has_reasons:
        return '<h3>Alerts</h3><p>Not known: the topic why was not recorded.</p>'
    rows = (_alert_row(alert, zone) for alert in robot.alerts()[-MOST_ROWS:])
    table = _table(('raised', 'over', 'level', 'what'), rows)
    return f'<h3>Alerts</h3>{table or "<p>None.</p>"}'


def _alert_row(alert: Alert, zone: ZoneInfo) -> tuple[str, ...]:
    over = 'not over' if alert.cleared is None else _clock(alert.cleared, zone)
    return _clock(alert.raised, zone), over, alert.level, alert.sentence


def _probes(robot: RobotDay) -> str:
    rows = [_probe_row(probe) for probe in robot.probes.values()]
    if not rows:
        return ''
    table = _table(('probe', 'signal', 'health', 'drank [L/m²]'), rows)
    note = (
        '<p class="note">What it drank is the integral of sap flux density over the time it was '
        'known: D = ∫ F dt with F = 118.99·10⁻⁶ K<sup>1.231</sup> m³/(m² s) and '
        'K = (ΔT<sub>max</sub> - ΔT) / ΔT (Granier 1985); 1 m³/m² is 1000 L/m² of '
        'sapwood. Of several probes the mean counts.</p>'
    )
    return f'<h3>Probes</h3>{table}{note}'


def _probe_row(probe: ProbeDay) -> tuple[str, ...]:
    totals = probe.conditions.totals()
    whole = sum(totals.values())
    health = ', '.join(
        f'{word} {100.0 * seconds / whole:.0f} %' if whole > 0.0 else word
        for word, seconds in totals.items()
        if seconds >= 0.005 * whole
    )
    drunk = NO_NUMBER if probe.drunk is None else f'{1000.0 * probe.drunk:.1f}'
    return probe.name, probe.signal, health, drunk


def _table(head: Iterable[str], rows: Iterable[tuple[str, ...]]) -> str:
    """Return a table; empty without a row."""
    body = ''.join(_row('td', row) for row in rows)
    return f'<div class="wide"><table>{_row("th", head)}{body}</table></div>' if body else ''


def _row(kind: str, cells: Iterable[str]) -> str:
    return f'<tr>{"".join(_cells(kind, cells))}</tr>'


def _cells(kind: str, cells: Iterable[str]) -> Iterator[str]:
    return (f'<{kind}>{escape(cell)}</{kind}>' for cell in cells)


def _local(moment: float, zone: ZoneInfo) -> datetime:
    return datetime.fromtimestamp(moment, timezone.utc).astimezone(zone)


def _clock(moment: float, zone: ZoneInfo) -> str:
    return f'{_local(moment, zone):%H:%M}'
