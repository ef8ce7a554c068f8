"""A mind among others: what the tree wants, as far as it has the right of way."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.motion.generator import polar_command
from agv_motion.motion.polar import STILL, PolarCommand
from agv_motion.motion.thought import ALONE, Surroundings

if TYPE_CHECKING:
    from agv_motion.motion.generator import SapFlow
    from agv_motion.motion.mind import Mind
    from agv_motion.motion.thought import Thought
    from agv_motion.motion.traffic.traffic import Passage, Traffic
    from agv_motion.planar import Pose


class Company:
    """Lets the mind choose the goal, and traffic the way there."""

    def __init__(self, mind: Mind, traffic: Traffic) -> None:
        """Join the two."""
        self.mind, self.traffic = mind, traffic
        self._blocked = 0.0

    def think(self, time: float, pose: Pose, flow: SapFlow, lived: float) -> Thought:
        """Return what to do now; see :meth:`Mind.think`.

        Args:
            time: Of the day, in seconds since 1970.
            pose: Where the tree is.
            flow: Of its sap.
            lived: Time of its steady clock [s], which no other tree's is compared with.

        Where the way to a goal of its own choice has been blocked for long, the mind chooses
        another of those that can be reached past the others.
        """
        mind, here = self.mind, (pose.x, pose.y)
        surroundings = ALONE
        if self._blocked > self.traffic.right.parameters.patience:
            mind.next_goal()
            surroundings = Surroundings(avoid=self.traffic.closed())
        thought = mind.think(time, pose, flow, surroundings)
        self._blocked = 0.0
        if thought.wanted == STILL and not thought.aside:
            self.traffic.rest(here, lived)
            return thought
        goal = thought.way[-1] if thought.way else None
        passage = self.traffic.towards(goal, here, lived)
        if (
            goal is not None
            and thought.goal is mind.goal
            and mind.parameters.goals.strategy != 'fixed'
        ):
            self._blocked = passage.blocked
        return _heading(thought, passage, pose, flow)


def _heading(thought: Thought, passage: Passage, pose: Pose, flow: SapFlow) -> Thought:
    """Return ``thought`` with the heading, the way and the reason of ``passage``."""
    if passage.target is None and not thought.way:
        return thought
    omega, here = thought.wanted.omega, (pose.x, pose.y)
    activity = f'{thought.activity}: {passage.reason}' if passage.reason else thought.activity
    wanted = PolarCommand(0.0, 0.0, omega)
    if passage.target is not None:
        speed = thought.wanted.v if thought.way else 0.0
        speed = max(speed, thought.aside) if passage.gives_way else speed
        wanted = polar_command(flow._replace(s1=speed), pose, passage.target)._replace(omega=omega)
    return thought._replace(wanted=wanted, activity=activity, way=(here, *passage.way))
