"""Whether a robot that is told to move does not: it is held, wedged, or its motors are off.

What it was told is summed up as the path that the commands alone would have led it, so that a
command that trembles about zero tells nothing. What it did is its pose, averaged over a while, so
that noise is no motion and a slow robot is seen to move. There is no answer before commands have
led so far that even a coarse or late pose would show it.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from math import exp, hypot
from typing import Annotated

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check
from agv_motion.planar import REST, Pose, Twist, integrate, require_finite, wrap


class AfterBlock(Enum):
    """What a blocked robot does next."""

    STOP = 'stop'
    """It stands until a person lets it go on"""
    RETRY = 'retry'
    """It tries again by itself"""


AVERAGED = 0.2
"""[-] Time constant of the averages, as a share of the time after which a robot is blocked."""

NOISE = 2.0
"""[-] Less than this many times the mean noise of the pose is no motion. A robot that moves evenly
seems noisy too, as the average lags, but by a fifth of what it moves in that time."""

LEAST = 0.001
"""[m] Nor is less than this."""

LONG_REST = 1.0
"""[s] After a longer rest what was told before counts no more."""

HERE = Pose(0.0, 0.0, 0.0)


After = Annotated[
    float,
    Spec('time without motion, though told to move, until it stops; 0: never', 's', (0.0, 3600.0),
         dynamic=True),
]  # fmt: skip
Distance = Annotated[
    float,
    Spec('steps or drift of the pose of a robot that stands; it is to be told twice as much first',
         'm', (0.001, 100.0), dynamic=True),
]  # fmt: skip
Then = Annotated[
    str,
    Spec('stop: until a person lets it go on; or try again by itself',
         choices=tuple(each.value for each in AfterBlock), dynamic=True),
]  # fmt: skip
RetryAfter = Annotated[
    float, Spec('time to stand before it tries again', 's', (0.1, 1e5), dynamic=True)
]


@dataclass(frozen=True)
class BlockedParameters:
    """When a robot that is told to move and does not is blocked, and what then."""

    after: After = 5.0
    distance: Distance = 0.05
    then: Then = AfterBlock.STOP.value
    retry_after: RetryAfter = 10.0

    def __post_init__(self) -> None:
        """Check every row, and that a short glitch is no block."""
        check(self)
        if 0.0 < self.after < 0.5:
            msg = f'after = {self.after} s: give 0.5 s or more, or 0 to look for no block at all'
            raise ConfigurationError(msg)

    @property
    def tries_again(self) -> bool:
        """Whether a blocked robot goes on by itself."""
        return AfterBlock(self.then) is AfterBlock.RETRY


@dataclass(frozen=True)
class SlowlyBlockedParameters(BlockedParameters):
    """The same for a tree: a metre a minute, a pose by radio, and nobody beside it."""

    after: After = 30.0
    distance: Distance = 0.3
    then: Then = AfterBlock.RETRY.value
    retry_after: RetryAfter = 60.0


class PoseAverage:
    """The pose over a while, and how much single poses differ from that."""

    def __init__(self, arm: float) -> None:
        """Know none; a turn is measured at ``arm`` [m] from the centre."""
        self._arm = arm
        self.forget()

    def forget(self) -> None:
        """Begin with the next pose."""
        self.mean: Pose | None = None
        self.noise = 0.0
        """Mean distance of a pose from the average [m]"""

    def add(self, pose: Pose, share: float) -> None:
        """Take up a pose; it counts for a ``share`` of the average."""
        mean = pose if self.mean is None else self.mean
        self.noise += share * (self.distance(mean, pose) - self.noise)
        self.mean = Pose(
            mean.x + share * (pose.x - mean.x),
            mean.y + share * (pose.y - mean.y),
            wrap(mean.theta + share * wrap(pose.theta - mean.theta)),
        )

    def distance(self, first: Pose, second: Pose) -> float:
        """Return how far two poses are apart [m], the turn measured at the arm."""
        (ax, ay, a), (bx, by, b) = first, second
        return hypot(bx - ax, by - ay) + self._arm * abs(wrap(b - a))


class ToldPath:
    """Where the commands alone would have led a robot from its anchor."""

    def __init__(self, anchor: Pose) -> None:
        """Begin at ``anchor``, where the robot was."""
        self.anchor = anchor
        self.end = HERE
        """Where they lead, seen from the anchor"""
        self.time = self.reach = 0.0
        """For how long they have led [s], and how far from the anchor at most [m]"""


class BlockedWatch:
    """Compares what a robot is told with how its pose changes."""

    def __init__(self, parameters: BlockedParameters, arm: float) -> None:
        """Know nothing.

        Args:
            parameters: When it is blocked.
            arm: Distance from the centre at which a turn is measured as a motion [m].

        """
        self.parameters = parameters
        self._average = PoseAverage(arm)
        self.restart()

    def restart(self) -> None:
        """Forget: another motion begins."""
        self._average.forget()
        self._told = ToldPath(HERE)
        self._rested = 0.0

    @property
    def told(self) -> float:
        """How far from the anchor the commands alone would have led it [m]."""
        return self._told.reach

    def update(self, pose: Pose, twist: Twist, dt: float) -> bool:
        """Return whether the robot is blocked.

        Args:
            pose: As it is measured now.
            twist: Told for the time ``dt``.
            dt: Since the last call [s].

        Raises:
            SignalError: A number is not finite.

        """
        require_finite('dt, pose and twist', (dt, *pose, *twist))
        given, average = self.parameters, self._average
        if average.mean is None:
            self._told = ToldPath(pose)
        tau = AVERAGED * given.after
        average.add(pose, 1.0 - exp(-dt / tau) if tau > 0.0 else 1.0)
        self._rested = self._rested + dt if twist == REST else 0.0
        if self._rested > LONG_REST or self._has_moved():
            self._told = ToldPath(average.mean or pose)
        if twist == REST or given.after == 0.0:
            return False
        told = self._told
        told.time += dt
        told.end = integrate(told.end, twist, dt)
        told.reach = max(told.reach, average.distance(HERE, told.end))
        return told.time >= given.after and told.reach >= 2.0 * given.distance

    def describe(self) -> str:
        """Return what it was told and what it did, in words."""
        return (
            f'told to move by {self.told:.2f} m in {self._told.time:.1f} s, it moved by '
            f'{self._moved():.3f} m'
        )

    def _has_moved(self) -> bool:
        least = max(LEAST, NOISE * self._average.noise)
        return self._moved() >= min(least, self.parameters.distance)

    def _moved(self) -> float:
        anchor = self._told.anchor
        return self._average.distance(anchor, self._average.mean or anchor)


class BlockedGuard:
    """Stops a robot that is blocked, until a person lets it go on or it tries again by itself."""

    def __init__(self, parameters: BlockedParameters, arm: float, remedy: str) -> None:
        """Let it move.

        Args:
            parameters: When it is blocked, and what then.
            arm: Distance from the centre at which a turn is measured as a motion [m].
            remedy: What a person can do, for the reason.

        """
        self.watch = BlockedWatch(parameters, arm)
        self.reason = ''
        """Why it must not move; empty if it may"""
        self._remedy = remedy
        self._stood = 0.0

    def release(self) -> None:
        """Let it move again."""
        self.reason, self._stood = '', 0.0
        self.watch.restart()

    def update(self, pose: Pose | None, twist: Twist, dt: float) -> bool:
        """Return whether it has been found blocked just now; `reason` tells how it is.

        Args:
            pose: As it is measured now; None while it is not.
            twist: Told for the time ``dt``.
            dt: Since the last call [s].

        """
        given = self.watch.parameters
        if self.reason:
            self._stood += dt
            if given.tries_again and self._stood >= given.retry_after:
                self.release()
        elif pose is None:
            self.watch.restart()
        elif self.watch.update(pose, twist, dt):
            next_ = f'trying again in {given.retry_after:g} s' if given.tries_again else ''
            self.reason = f'blocked: {self.watch.describe()}; {next_ or self._remedy}'
            return True
        return False
