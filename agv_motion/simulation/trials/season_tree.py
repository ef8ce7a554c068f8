"""One tree of a season: where it is, where it believes it is, its sap, its agent, its tally."""

from __future__ import annotations

from math import exp, hypot, inf, sqrt
from typing import TYPE_CHECKING

from agv_motion.motion.command.polar import LINEAR_SPEED, STILL, to_twist
from agv_motion.motion.pilot import Pilot
from agv_motion.planar import Pose, integrate
from agv_motion.simulation.sap import SapSense

if TYPE_CHECKING:
    import random
    from collections.abc import Callable

    from agv_motion.motion.behavior.agent import Agent
    from agv_motion.motion.navigation.polyline import Point
    from agv_motion.motion.navigation.reservations.shared_navigator import SharedNavigator
    from agv_motion.motion.pilot import MotionCommand

STEPPED = 0.1
"""[m] A tree that has moved so far does not stand."""

ERROR_TIME = 300.0
"""[s] over which the error of a position stays about the same."""


class SeasonTree:
    """One tree; it follows exactly what it is told, off by the error of its position."""

    def __init__(
        self,
        name: str,
        agent: Agent,
        navigator: SharedNavigator,
        place: Point,
        chance: random.Random,
    ) -> None:
        """Stand at ``place``, looking anywhere."""
        self.name, self.agent, self.navigator = name, agent, navigator
        self._pilot = Pilot(agent, navigator)
        self.pose = Pose(*place, chance.uniform(-3.0, 3.0))
        self.sense = SapSense(chance.randrange(2**20))
        self._chance = chance
        self._error = (0.0, 0.0)
        self.walked, self.goals, self.longest_stand = 0.0, 0, 0.0
        self._anchor, self._moved_at = place, inf
        self._goal: object = None

    def live(
        self, now: float, light: Callable[[float, float], float], step: float, deviation: float
    ) -> bool:
        """Feel, think and move for one step; return whether the tree moves.

        Args:
            now: Time [s].
            light: What of the full sun falls on (x, y) [m].
            step: How long it moves [s].
            deviation: Standard deviation of the error of x and of y, never beyond three of it [m].

        """
        x, y, theta = self.pose
        flow = self.sense.feel(now, light(x, y))
        keep = exp(-step / ERROR_TIME)
        fresh = deviation * sqrt(1.0 - keep * keep)
        dx, dy = (keep * e + self._chance.gauss(0.0, fresh) for e in self._error)
        shrink = min(3.0 * deviation / max(hypot(dx, dy), 1e-9), 1.0)
        self._error = dx, dy = shrink * dx, shrink * dy
        motion = self._pilot.update(now, Pose(x + dx, y + dy, theta), flow, now)
        self._count(motion, now, flow.s1)
        command = motion.wanted
        if command == STILL:
            return False
        if len(motion.path) > 1:  # a step never leads past the corner it heads for
            (ax, ay), (bx, by) = motion.path[:2]
            most = hypot(bx - ax, by - ay) / (LINEAR_SPEED * step)
            command = command._replace(v=min(command.v, most))
        twist = to_twist(command)
        self.pose = integrate(self.pose, twist, step)
        self.walked += hypot(self.pose.x - x, self.pose.y - y)
        return True

    def count_from(self, now: float) -> None:
        """Count how long the tree stands from now [s] on: so far it could not help it."""
        self._moved_at = now

    def _count(self, motion: MotionCommand, now: float, speed: float) -> None:
        """Count goals, and how long the tree has stood with somewhere to go."""
        if motion.goal is not self._goal and motion.goal is not None:
            self._goal = motion.goal
            self.goals += motion.goal.objective is not None
        here = self.pose.x, self.pose.y
        seeks = speed > 0.0 and motion.goal is not None and bool(motion.path)
        if not seeks or hypot(here[0] - self._anchor[0], here[1] - self._anchor[1]) > STEPPED:
            self._anchor, self._moved_at = here, now
        self._moved_at = min(self._moved_at, now)
        self.longest_stand = max(self.longest_stand, now - self._moved_at)
