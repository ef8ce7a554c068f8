"""The link of the wheels: whether they turn, what they were commanded, and who holds them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from agv_motion.activity import HeldBy
from agv_motion.explanation.link import Level, Link, worst
from agv_motion.explanation.words import ago

if TYPE_CHECKING:
    from agv_motion.explanation.evidence import Evidence, Report

DRIVERS = ('wheel_kinematics', 'differential_kinematics', 'omni_kinematics')
"""Nodes that command wheels"""

STILL = 0.0005
"""[m/s] A wheel that rolls more slowly stands: encoders have noise."""

SILENT = 2.0
"""[s] after which what is told again and again is silent"""

REPORT_OLD = 4.0
"""[s] after which a node has missed three reports of its own"""

IGNORED = 5.0
"""[s] for which wheels may stand though told to turn: they accelerate, turrets turn first."""

CLOCK = 'look at the clock: /clock in a simulation, else that of this machine'
"""What to do where a node does not believe its clock"""

REMEDIES = {
    HeldBy.PERSON: 'let them go: call {node}/stop with data: false',
    HeldBy.FIGHT: 'look at the turrets, then call {node}/stop with data: false',
    HeldBy.ENCODERS: 'look at the encoders, their cable and their power',
    HeldBy.ANGLES: 'look at the encoder of the turret that is named',
    HeldBy.BLOCKED: 'clear the wheels and see to the motors, then send a zero cmd_vel',
}


class SeenWheels(NamedTuple):
    """What the node of the wheels tells of them."""

    age: float | None
    """[s] of the measurement; None: nothing was ever measured"""
    speed: float
    """[m/s] of the fastest, as measured"""
    commanded: float
    """[m/s] of the fastest"""

    @property
    def turning(self) -> bool:
        """Whether a wheel turns."""
        return self.speed >= STILL


def look(report: Report) -> SeenWheels:
    """Return what the wheels do, as their node has told; ages as they were then."""
    return SeenWheels(
        report.number('encoders age [s]'),
        report.number('wheel speed [m/s]') or 0.0,
        report.number('commanded wheel speed [m/s]') or 0.0,
    )


def wheels_link(evidence: Evidence, now: float, ignored: float) -> Link:
    """Return how the wheels are.

    Args:
        evidence: Of the robot.
        now: By the clock of whoever hears it [s].
        ignored: For how long they have stood though told to turn [s].

    """
    found = evidence.first(DRIVERS)
    if found is None:
        unheard = 'nothing is heard of the wheels'
        return Link(
            'wheels', Level.STALE, unheard, unheard,
            remedy=f'start their node: one of {", ".join(DRIVERS)}',
        )  # fmt: skip
    name, report = found
    if now - report.at > REPORT_OLD:
        silent = f'{name} is silent for {ago(now - report.at)}'
        return Link(
            'wheels', Level.ERROR, f'{silent}; nobody commands the wheels', f'{name} is silent',
            remedy=f'see whether {name} still runs, and start it', age=now - report.at,
        )  # fmt: skip
    seen, held = look(report), _held_by(report)
    if fault := report.clock_fault:
        return Link('wheels', report.level, report.message, fault, remedy=CLOCK, age=seen.age)
    if held is HeldBy.ARBITER:
        return Link(
            'wheels', Level.WARN, f'wheels are told to stand at once; {report.message}',
            'wheels stand', 'cmd_vel', age=seen.age,
        )  # fmt: skip
    if held is not HeldBy.NOBODY:
        return Link(
            'wheels', Level.ERROR, f'wheels are held: {report.message}',
            f'wheels are held: {report.message}', remedy=REMEDIES[held].format(node=name),
            age=seen.age,
        )  # fmt: skip
    return _moving(seen, report, ignored)


def _moving(seen: SeenWheels, report: Report, ignored: float) -> Link:
    """Return how wheels are that nobody holds."""
    level, limit = report.level, report.values.get('limited by', '')
    if seen.age is None:
        return Link(
            'wheels', worst(level, Level.WARN), 'no encoders are heard: nobody sees what they do',
            'no encoders are heard', 'cmd_vel', 'look at the encoders and their topic', limit,
        )  # fmt: skip
    if seen.age > SILENT:
        return Link(
            'wheels', Level.ERROR, f'the encoders are silent for {ago(seen.age)}',
            'the encoders are silent', remedy=REMEDIES[HeldBy.ENCODERS], age=seen.age,
        )  # fmt: skip
    if seen.turning:
        doing = f'wheels turn, the fastest at {seen.speed:.4f} m/s'
        residual = report.number('residual [m/s]')
        if residual is not None:
            doing += f'; they pull against each other by {residual:.4f} m/s'
        told = f'; {report.message}' if level is not Level.OK else ''
        return Link('wheels', level, doing + told, 'wheels turn', 'cmd_vel', '', limit, seen.age)
    if seen.commanded >= STILL and ignored > IGNORED:
        return Link(
            'wheels', Level.ERROR, f'wheels stand though told to turn for {ago(ignored)}',
            'wheels stand though told to turn',
            remedy='look at the motors, their fuses and the emergency stop', age=seen.age,
        )  # fmt: skip
    stands = 'wheels do not turn yet' if seen.commanded >= STILL or limit else 'wheels stand'
    return Link('wheels', Level.OK, stands, stands, 'cmd_vel', '', limit, seen.age)


def _held_by(report: Report) -> HeldBy:
    try:
        return HeldBy(report.values.get('held by', HeldBy.NOBODY.value))
    except ValueError:
        return HeldBy.NOBODY
