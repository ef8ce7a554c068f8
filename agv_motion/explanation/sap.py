"""The links of a tree's senses: its sap flow, and each probe."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.explanation.link import Level, Link
from agv_motion.explanation.wheels import CLOCK, REPORT_OLD
from agv_motion.explanation.words import ago, clock
from agv_motion.probe.condition import LEARNING, NO_READING
from agv_motion.probe.quality import Quality

if TYPE_CHECKING:
    from collections.abc import Iterator

    from agv_motion.explanation.evidence import Evidence, Report

MOST_PROBES = 16

USABLE = frozenset({each.value for each in Quality if each.usable})

REMEDIES = {
    Quality.OFF.value: 'look at its heater',
    Quality.MISSING.value: 'look at its cable and at the logger',
    Quality.OUT_OF_RANGE.value: 'look at its thermocouple, and at the unit of the source',
    Quality.SPIKE.value: 'wait; if it lasts look for a loose contact',
    Quality.STUCK.value: 'look at the logger: it repeats one value',
    Quality.NOISE.value: 'look at its cable and needles: what comes is noise',
    NO_READING: 'look at the source of its readings',
    LEARNING: 'wait: it learns zero flow in a night and its range in a day',
}
"""What a person can do, by the condition of a probe"""

SOURCE = 'look at the logger and its line, or at the source of the readings'


def sap_links(evidence: Evidence, now: float, time: float, time_zone: str) -> list[Link]:
    """Return the sap flow and its probes; nothing of a robot that has none.

    Args:
        evidence: Of the robot.
        now: By the clock of whoever hears it [s].
        time: By the robot's clock [s since 1970].
        time_zone: In which times are told.

    """
    report = evidence.nodes.get('granier_probe')
    if report is None:
        return [_unreported()] if 'motion_generator' in evidence.nodes else []
    probes = list(_probes(report, now, time, time_zone))
    return [_flow(report, now, probes), *probes]


def _unreported() -> Link:
    return Link('sap flow', Level.STALE, 'no probes are heard', 'no probes are heard',
                remedy='start granier_probe')  # fmt: skip


def _flow(report: Report, now: float, probes: list[Link]) -> Link:
    age = silent = now - report.at
    if silent > REPORT_OLD:
        return Link(
            'sap flow', Level.ERROR, f'granier_probe is silent for {ago(silent)}',
            'granier_probe is silent', remedy='see whether granier_probe still runs, and start it',
            age=silent,
        )  # fmt: skip
    if fault := report.clock_fault:
        return Link('sap flow', report.level, report.message, fault, remedy=CLOCK, age=age)
    bad = next((probe for probe in probes if probe.level is not Level.OK and probe.limit), None)
    if bad is not None:
        return Link('sap flow', Level.WARN, report.message, '', bad.name, age=age)
    source, limit = (report.number(f'source silent{name} [s]') for name in ('', ' limit'))
    if source is not None and limit is not None and source > limit:
        return Link('sap flow', Level.ERROR, report.message, f'no reading for {ago(source)}',
                    remedy=SOURCE, age=age)  # fmt: skip
    if report.level is not Level.OK:
        return Link('sap flow', report.level, report.message, report.message,
                    remedy='look at granier_probe: agv nodes', age=age)  # fmt: skip
    return Link('sap flow', Level.OK, _values(report), 'the sap flow is told', age=age)


def _values(report: Report) -> str:
    signals = {
        text: report.number(key.replace('signal', 'sap flow'))
        for key, text in report.values.items()
        if key.endswith(' signal') and text
    }
    told = (f'{s} {"unknown" if n is None else f"{n:.2f}"}' for s, n in sorted(signals.items()))
    return 'sap flow: ' + ', '.join(told)


def _probes(report: Report, now: float, time: float, time_zone: str) -> Iterator[Link]:
    """Yield each probe; ``limit`` tells which signal of the tree it is, if any."""
    for i in range(1, MOST_PROBES + 1):
        name = f'probe_{i}'
        condition = report.values.get(f'{name} condition')
        if condition is None:
            return
        since, signal = report.number(f'{name} since [s]'), report.values.get(f'{name} signal', '')
        since = since if since is None or since > 0.0 else None
        good = condition in USABLE
        when = clock(since, time, time_zone)
        told = f' since {when}' if when and not good else ''
        difference, flow = report.number(f'{name} dT [K]'), report.number(f'{name} sap flow')
        numbers = [] if difference is None else [f'dT {difference:.2f} K']
        numbers += [] if flow is None else [f'sap flow {flow:.2f}']
        yield Link(
            name,
            Level.OK if good else Level.WARN,
            ', '.join([f'probe {i} is {condition}{told}', *numbers]),
            f'probe {i} is {condition}{told}',
            remedy='' if good else REMEDIES.get(condition, 'look at the probe'),
            limit=f'is {signal}' if signal else '',
            age=now - report.at,
            since=since,
        )
