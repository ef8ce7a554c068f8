"""The link of `cmd_vel`: what is commanded, who drives, and why others do not."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.explanation.link import Level, Link
from agv_motion.explanation.wheels import DRIVERS, SILENT
from agv_motion.explanation.words import ago

if TYPE_CHECKING:
    from agv_motion.explanation.evidence import Evidence, Report

DRIVER_OLD = 4.0
"""[s] after which the arbiter has missed three of its own words"""

BY_HAND = ('manual', 'page', 'stop')
"""Sources behind which a person stands, and no decision of the robot"""

RELEASE = 'release it: on the page, or call arbiter/stop with data: false'


def command_link(evidence: Evidence, now: float) -> Link:
    """Return how `cmd_vel` is, and whether that goes back to a decision of the robot."""
    found = evidence.first(DRIVERS)
    twist, silent = (None, None) if found is None else _heard(found[1])
    if (driver := evidence.driver) is not None:
        return _arbitrated(driver, now - driver.at, twist, silent)
    if silent is None:
        return _nobody('cmd_vel was never heard', 'nobody commands', None)
    if silent > SILENT:
        return _nobody(f'cmd_vel is silent for {ago(silent)}', 'cmd_vel is silent', silent)
    by = ', '.join(evidence.commanders)
    return _told(twist, f', from {by}' if by else '', silent)


def _heard(report: Report) -> tuple[tuple[float, ...] | None, float | None]:
    """Return the twist that the wheels were told last, and for how long they heard none [s]."""
    numbers = [report.number(name) for name in ('vx [m/s]', 'vy [m/s]', 'wz [rad/s]')]
    known = tuple(number for number in numbers if number is not None)
    return known if len(known) == 3 else None, report.number('cmd_vel age [s]')


def _arbitrated(
    driver: Report, age: float, twist: tuple[float, ...] | None, silent: float | None
) -> Link:
    if (held := _held(driver, age)) is not None:
        return held
    if silent is None or silent > SILENT:
        heard = 'was never heard' if silent is None else f'is silent for {ago(silent)}'
        return _nobody(f'cmd_vel {heard}; {driver.message}', 'cmd_vel is silent', silent)
    link, who = _told(twist, f'; {driver.message}', silent), driver.values.get('driver', '')
    if who in BY_HAND:
        clause = f'{link.clause}: {who} drives' if link.clause else f'{who} drives'
        return link._replace(because='', clause=clause)
    return link


def _held(driver: Report, age: float) -> Link | None:
    """Return what the arbiter lets the robot stand for; None if it lets somebody drive."""
    who, stop = driver.values.get('driver', ''), driver.values.get('stop', '')
    if age > DRIVER_OLD:
        return Link(
            'cmd_vel', Level.ERROR, f'the arbiter is silent for {ago(age)}: nobody drives',
            'the arbiter is silent', remedy='see whether arbiter still runs, and start it', age=age,
        )  # fmt: skip
    if stop:
        return Link(
            'cmd_vel', Level.ERROR, driver.message, f'STOP holds: {stop}', remedy=RELEASE, age=age
        )
    if who in {'', 'none'}:
        return Link('cmd_vel', driver.level, driver.message, 'nobody drives', 'decision', age=age)
    if driver.level is not Level.OK and (driver.values.get('lost') or driver.values.get('lock')):
        return Link(
            'cmd_vel', driver.level, driver.message, f'the robot stands for {who}',
            remedy='let that person go on, or release it on the page', age=age,
        )  # fmt: skip
    return None


def _told(twist: tuple[float, ...] | None, who: str, age: float | None) -> Link:
    if twist is None:
        return Link(
            'cmd_vel', Level.ERROR, f'cmd_vel holds no numbers{who}', 'cmd_vel holds no numbers',
            remedy='mend whoever sends it', age=age,
        )  # fmt: skip
    vx, vy, wz = twist
    if not any(twist):
        return Link('cmd_vel', Level.OK, f'cmd_vel is zero{who}', 'cmd_vel is zero', 'decision',
                    age=age)  # fmt: skip
    return Link(
        'cmd_vel', Level.OK,
        f'cmd_vel asks for {vx:.4f} m/s ahead, {vy:.4f} m/s left, {wz:.4f} rad/s{who}',
        '', 'decision', age=age,
    )  # fmt: skip


def _nobody(sentence: str, clause: str, age: float | None) -> Link:
    return Link('cmd_vel', Level.WARN, sentence, clause, 'decision', age=age)
