"""The link of the pose: whether the robot knows where it is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.explanation.link import Level, Link
from agv_motion.explanation.wheels import REPORT_OLD, SILENT
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
    report, age = evidence.nodes.get('localization'), evidence.age('pose', now)
    if report is None and age is None:
        return _by_odometry(evidence, now)
    if report is None:
        return _without_report(age)
    silent = now - report.at
    if silent > REPORT_OLD:
        return Link(
            'pose', Level.ERROR, f'localization is silent for {ago(silent)}',
            'localization is silent', remedy='see whether localization still runs, and start it',
            age=silent,
        )  # fmt: skip
    return _told(report, age)


def _told(report: Report, age: float | None) -> Link:
    remedy = REMEDIES.get(state, '') if (state := _state(report)) is not None else ''
    if report.values.get('odom') == Silence.LOST.value:
        remedy = ENCODERS
    position, heading = (
        report.number(f'{name} deviation [{unit}]')
        for name, unit in (('position', 'm'), ('heading', 'rad'))
    )
    known = '' if position is None else f', known to {position:.2f} m'
    known += '' if heading is None else f' and {heading:.3f} rad'
    if age is None or age > SILENT:
        heard = 'was never told' if age is None else f'is silent for {ago(age)}'
        why = report.message
        return Link(
            'pose', Level.ERROR, f'the pose {heard}: {why}', f'no pose: {why}',
            remedy=remedy or 'look at localization: agv nodes', age=age,
        )  # fmt: skip
    return Link(
        'pose', report.level, f'{report.message}{known}', report.message,
        remedy=remedy if report.level is not Level.OK else '', age=age,
    )  # fmt: skip


def _without_report(age: float | None) -> Link:
    if age is not None and age <= SILENT:
        return Link('pose', Level.OK, 'the pose is told', 'the pose is told', age=age)
    silent = '' if age is None else f' for {ago(age)}'
    return Link(
        'pose', Level.ERROR, f'the pose is silent{silent}, and nobody tells why',
        'the pose is silent', remedy='start localization, or whatever tells the pose', age=age,
    )  # fmt: skip


def _by_odometry(evidence: Evidence, now: float) -> Link:
    age = evidence.age('odom', now)
    if age is None:
        return Link('pose', Level.STALE, 'neither pose nor odometry is heard', 'no pose',
                    remedy='start the node of the wheels, and localization')  # fmt: skip
    if age > SILENT:
        return Link('pose', Level.ERROR, f'odometry is silent for {ago(age)}',
                    'odometry is silent', remedy=ENCODERS, age=age)  # fmt: skip
    return Link('pose', Level.OK, 'odometry alone tells where it is', 'odometry', age=age)


def _state(report: Report) -> FusionState | None:
    return FusionState.__members__.get(report.values.get('state', '').upper())
