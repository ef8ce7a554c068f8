"""The link of the wheels: whether they turn, what they were commanded, and who holds them."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.activity import HeldBy
from agv_motion.explanation.link import Level, Link, worst
from agv_motion.explanation.words import ago

if TYPE_CHECKING:
    from agv_motion.explanation.evidence import Evidence, Report

DRIVERS = ('wheel_kinematics', 'differential_kinematics', 'omni_kinematics')
"""Nodes that command wheels"""

STILL = 0.005
"""[rad/s] A wheel that turns more slowly stands: 0.5 mm/s at a radius of 0.1 m."""

SILENT = 2.0
"""[s] after which what is told again and again is silent"""

REPORT_OLD = 4.0
"""[s] after which a node has missed three reports of its own"""

IGNORED = 5.0
"""[s] for which wheels may stand though told to turn: they accelerate, turrets turn first."""

REMEDIES = {
    HeldBy.PERSON: 'let them go: call {node}/stop with data: false',
    HeldBy.FIGHT: 'look at the turrets, then call {node}/stop with data: false',
    HeldBy.ENCODERS: 'look at the encoders, their cable and their power',
    HeldBy.ANGLES: 'look at the encoder of the turret that is named',
    HeldBy.BLOCKED: 'clear the wheels and see to the motors, then send a zero cmd_vel',
}


class SeenWheels(NamedTuple):
    """What the joints of a robot tell."""

    turning: bool | None
    """None: nothing is measured"""
    fastest: float
    """[rad/s]"""
    commanded: bool | None
    age: float | None
    """[s] of the measurement"""


def fastest_wheel(joints: Any) -> float | None:
    """Return how fast the fastest wheel of a sensor_msgs/JointState turns [rad/s].

    Joints that steer do not count. None where a number is missing or is none.
    """
    rates = [
        abs(float(rate))
        for name, rate in zip(joints.name, joints.velocity, strict=False)
        if not str(name).endswith('_steering')
    ]
    return max(rates) if rates and all(map(isfinite, rates)) else None


def look(evidence: Evidence, now: float) -> SeenWheels:
    """Return what the wheels do, as their encoders and their commands tell."""
    topic = 'turrets' if evidence.message('turrets/state') is not None else 'wheels'
    if evidence.message('turrets/command') is not None:
        topic = 'turrets'
    state, command = evidence.message(f'{topic}/state'), evidence.message(f'{topic}/command')
    rate = None if state is None else fastest_wheel(state)
    wanted = None if command is None else fastest_wheel(command)
    return SeenWheels(
        None if rate is None else rate >= STILL,
        rate or 0.0,
        None if wanted is None else wanted >= STILL,
        evidence.age(f'{topic}/state', now),
    )


def wheels_link(evidence: Evidence, now: float, ignored: float) -> Link:
    """Return how the wheels are.

    Args:
        evidence: Of the robot.
        now: By the clock of whoever hears it [s].
        ignored: For how long they have stood though told to turn [s].

    """
    seen, found = look(evidence, now), evidence.first(DRIVERS)
    if found is None:
        if seen.age is None:
            return Link(
                'wheels', Level.STALE, 'nothing is heard of the wheels', 'nothing is heard of them',
                remedy=f'start their node: one of {", ".join(DRIVERS)}',
            )  # fmt: skip
        return _moving(seen, None, ignored)
    name, report = found
    if now - report.at > REPORT_OLD:
        silent = f'{name} is silent for {ago(now - report.at)}'
        return Link(
            'wheels', Level.ERROR, f'{silent}; nobody commands the wheels', f'{name} is silent',
            remedy=f'see whether {name} still runs, and start it', age=now - report.at,
        )  # fmt: skip
    held = _held_by(report)
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


def _moving(seen: SeenWheels, report: Report | None, ignored: float) -> Link:
    """Return how wheels are that nobody holds."""
    level = report.level if report is not None else Level.OK
    limit = report.values.get('limited by', '') if report is not None else ''
    message = report.message if report is not None else ''
    if seen.age is None or seen.turning is None:
        return Link(
            'wheels', worst(level, Level.WARN), 'no encoders are heard: nobody sees what they do',
            'no encoders are heard', 'cmd_vel', 'look at the encoders and their topic',
            limit=limit, age=seen.age,
        )  # fmt: skip
    if seen.age > SILENT:
        return Link(
            'wheels', Level.ERROR, f'the encoders are silent for {ago(seen.age)}',
            'the encoders are silent', remedy=REMEDIES[HeldBy.ENCODERS], age=seen.age,
        )  # fmt: skip
    if seen.turning:
        doing = f'wheels turn, the fastest at {seen.fastest:.3f} rad/s'
        residual = report.number('residual [m/s]') if report is not None else None
        if residual is not None:
            doing += f'; they pull against each other by {residual:.4f} m/s'
        told = f'; {message}' if level is not Level.OK else ''
        return Link(
            'wheels', level, doing + told, 'wheels turn', 'cmd_vel', limit=limit, age=seen.age
        )
    if seen.commanded and ignored > IGNORED and not limit:
        return Link(
            'wheels', Level.ERROR, f'wheels stand though told to turn for {ago(ignored)}',
            'wheels stand though told to turn',
            remedy='look at the motors, their fuses and the emergency stop', age=seen.age,
        )  # fmt: skip
    stands = 'wheels do not turn yet' if seen.commanded or limit else 'wheels stand'
    return Link('wheels', Level.OK, stands, stands, 'cmd_vel', limit=limit, age=seen.age)


def _held_by(report: Report) -> HeldBy:
    try:
        return HeldBy(report.values.get('held by', HeldBy.NOBODY.value))
    except ValueError:
        return HeldBy.NOBODY
