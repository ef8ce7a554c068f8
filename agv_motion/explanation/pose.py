"""The link of the pose: whether the robot knows where it is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.explanation.link import Level, Link
from agv_motion.explanation.wheels import CLOCK, DRIVERS, REPORT_OLD, SILENT, look
from agv_motion.explanation.words import ago
from agv_motion.odometry.fusion_report import FusionState
from agv_motion.watchdog import Silence

if TYPE_CHECKING:
    from agv_motion.explanation.evidence import Evidence, Report

ENCODERS = 'look at the encoders: odometry has ended'

REMEDIES = {
    FusionState.WAITING: 'look at odometry and at the system of position fixes',
    FusionState.SEARCHING: 'set the pose (localization/set_pose), or let the robot drive a metre',
    FusionState.DOUBTFUL: 'look whether it was carried away, or at the system of position fixes',
    FusionState.ODOMETRY_ONLY: 'look at the system of position fixes',
}


def pose_link(evidence: Evidence, now: float) -> Link:
    """Return how well the robot knows where it is; by odometry alone where there is no more."""
    report = evidence.nodes.get('localization')
    if report is None:
        return _by_odometry(evidence)
    silent = now - report.at
    if fault := report.clock_fault:
        return Link('pose', report.level, report.message, fault, remedy=CLOCK, age=silent)
    if silent > REPORT_OLD:
        return Link(
            'pose', Level.ERROR, f'localization is silent for {ago(silent)}',
            'localization is silent', remedy='see whether localization still runs, and start it',
            age=silent,
        )  # fmt: skip
    return _told(report, silent)


def _told(report: Report, age: float) -> Link:
    remedy = REMEDIES.get(state, '') if (state := _state(report)) is not None else ''
    if report.values.get('odom') == Silence.LOST.value:
        remedy = ENCODERS
    position, heading = (
        report.number(f'{name} deviation [{unit}]')
        for name, unit in (('position', 'm'), ('heading', 'rad'))
    )
    known = '' if position is None else f', known to {position:.2f} m'
    known += '' if heading is None else f' and {heading:.3f} rad'
    if report.values.get('pose told') == 'no':
        why = report.message
        return Link(
            'pose', report.level, f'no pose is told: {why}', f'no pose: {why}',
            remedy=remedy or 'look at localization: agv nodes', age=age,
        )  # fmt: skip
    return Link(
        'pose', report.level, f'{report.message}{known}', report.message,
        remedy=remedy if report.level is not Level.OK else '', age=age,
    )  # fmt: skip


def _by_odometry(evidence: Evidence) -> Link:
    found = evidence.first(DRIVERS)
    age = None if found is None else look(found[1]).age
    if age is None:
        return Link('pose', Level.STALE, 'neither localization nor odometry is heard', 'no pose',
                    remedy='start the node of the wheels, and localization')  # fmt: skip
    if age > SILENT:
        return Link('pose', Level.ERROR, f'odometry is silent for {ago(age)}',
                    'odometry is silent', remedy=ENCODERS, age=age)  # fmt: skip
    return Link('pose', Level.OK, 'odometry alone tells where it is', 'odometry', age=age)


def _state(report: Report) -> FusionState | None:
    return FusionState.__members__.get(report.values.get('state', '').upper())
