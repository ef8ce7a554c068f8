"""The link of the decision: what the node that decides does, and what that goes back to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.activity import Activity, Cause
from agv_motion.explanation.link import Level, Link, worst
from agv_motion.explanation.wheels import CLOCK, REPORT_OLD
from agv_motion.explanation.words import ago

if TYPE_CHECKING:
    from agv_motion.explanation.evidence import Evidence, Report

DECIDERS = ('motion_generator', 'sequence', 'route_follower', 'ghost_trajectory')
"""Nodes that decide, those that drive a tree first"""

OF_SOURCE = {'agent': DECIDERS[:1], 'sequence': DECIDERS[1:2], 'route': DECIDERS[2:]}
"""Which of them speak as a source of the arbiter"""

LEVELS = {
    Activity.BLOCKED: Level.ERROR,
    Activity.STOPPED: Level.ERROR,
    Activity.FAILED: Level.ERROR,
    Activity.WAITING: Level.WARN,
    Activity.PAUSED: Level.WARN,
    Activity.STARTING: Level.WARN,
}
"""of an activity; of others OK"""

UPSTREAM = {
    Cause.PROBES: 'sap flow', Cause.SAP_FLOW: 'sap flow', Cause.POSE: 'pose',
}  # fmt: skip
"""Links that a decision goes back to"""

REMEDIES = {
    Cause.PERSON: 'whoever asked for it can end it, on the page',
    Cause.CLOCK: CLOCK,
    Cause.ZONE: 'drive it to free floor, or look at the zone',
    Cause.OTHERS: 'wait; if it lasts look at the tree that is named',
    Cause.MOTION: 'clear its way, look at wheels and motors, then let it go on',
    Cause.NOTHING: 'send a goal, a route or a start',
}
"""What a person can do where the decision itself is the first cause"""


def decision_link(evidence: Evidence, now: float, driver: str) -> Link:
    """Return what the robot has decided.

    Args:
        evidence: Of the robot.
        now: By the clock of whoever hears it [s].
        driver: Source that drives, as the arbiter tells; empty if nobody knows.

    """
    found = _decider(evidence, driver)
    if found is None:
        return Link(
            'decision', Level.STALE, 'no node that decides is heard', 'nobody decides',
            remedy=f'start one of {", ".join(DECIDERS)}',
        )  # fmt: skip
    name, report = found
    age = now - report.at
    if age > REPORT_OLD:
        return Link(
            'decision', Level.ERROR, f'{name} is silent for {ago(age)}', f'{name} is silent',
            remedy=f'see whether {name} still runs, and start it', age=age,
        )  # fmt: skip
    activity, because = _read(report)
    if activity is None:
        return Link('decision', worst(report.level, Level.WARN), f'{name}: {report.message}',
                    report.message, remedy=f'activate {name}: see agv nodes', age=age)  # fmt: skip
    return _decided(report, activity, because, age)


def _decided(report: Report, activity: Activity, because: Cause, age: float) -> Link:
    upstream = UPSTREAM.get(because, '')
    level = LEVELS.get(activity, Level.OK)
    stands = not activity.moves
    if upstream and stands:
        level, clause = worst(level, Level.WARN), activity.value
    else:
        clause = report.message
    limit = report.values.get('limits in force', '')
    needs_remedy = level is not Level.OK or because is Cause.PERSON
    return Link(
        'decision', level, report.message, clause, upstream if stands else '',
        REMEDIES.get(because, '') if needs_remedy and stands else '',
        '' if limit == 'none' else limit, age, report.number('since [s]'),
    )  # fmt: skip


def _decider(evidence: Evidence, driver: str) -> tuple[str, Report] | None:
    """Return the node that decides: that which drives, or else one that moves, or the first."""
    known = [(name, evidence.nodes[name]) for name in DECIDERS if name in evidence.nodes]
    of_driver = [each for each in known if each[0] in OF_SOURCE.get(driver, ())]
    candidates = of_driver or known
    moving = [each for each in candidates if (found := _read(each[1])[0]) and found.moves]
    return next(iter(moving or candidates), None)


def _read(report: Report) -> tuple[Activity | None, Cause]:
    try:
        return Activity(report.values['activity']), Cause(report.values['because'])
    except (KeyError, ValueError):
        return None, Cause.NOTHING
