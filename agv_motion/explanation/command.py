"""The link of `cmd_vel`: what is commanded, who drives, and why others do not."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING, Any

from agv_motion.explanation.evidence import report_of
from agv_motion.explanation.link import Level, Link
from agv_motion.explanation.wheels import SILENT
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
    message, age = evidence.message('driver'), evidence.age('driver', now)
    twist, silent = _twist(evidence.message('cmd_vel')), evidence.age('cmd_vel', now)
    if message is not None and age is not None:
        return _arbitrated(report_of(message, now - age), age, twist, silent)
    if silent is None:
        return _nobody('cmd_vel was never heard', 'nobody commands', None)
    if silent > SILENT:
        return _nobody(f'cmd_vel is silent for {ago(silent)}', 'cmd_vel is silent', silent)
    by = ', '.join(evidence.commanders or ())
    who = f', from {by}' if by else ''
    return _told(twist, who, silent)


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
        return link._replace(because='', clause=f'{link.clause}: {who} drives')
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


def _twist(message: Any) -> tuple[float, ...] | None:
    """Return vx, vy and wz of a Twist or TwistStamped; None if they are no numbers."""
    if message is None:
        return None
    twist = getattr(message, 'twist', message)
    numbers = float(twist.linear.x), float(twist.linear.y), float(twist.angular.z)
    return numbers if all(map(isfinite, numbers)) else None
