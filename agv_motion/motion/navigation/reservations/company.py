"""A mind among others: what the tree wants, as far as it has the right of way."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.motion.behavior.decision import ALONE, Surroundings
from agv_motion.motion.command.polar import STILL, PolarCommand, polar_command

if TYPE_CHECKING:
    from agv_motion.motion.behavior.agent import Agent
    from agv_motion.motion.behavior.decision import Decision
    from agv_motion.motion.behavior.sap_flow import SapFlow
    from agv_motion.motion.navigation.reservations.traffic import Passage, Traffic
    from agv_motion.planar import Pose


class Company:
    """Lets the mind choose the goal, and traffic the path there."""

    def __init__(self, agent: Agent, traffic: Traffic) -> None:
        """Join the two."""
        self.agent, self.traffic = agent, traffic
        self._blocked = 0.0

    def decide(self, time: float, pose: Pose, flow: SapFlow, lived: float) -> Decision:
        """Return what to do now; see :meth:`Agent.decide`.

        Args:
            time: Of the day, in seconds since 1970.
            pose: Where the tree is.
            flow: Of its sap.
            lived: Time of its steady clock [s], which no other tree's is compared with.

        Where the path to a goal of its own choice has been blocked for long, the mind chooses
        another of those that can be reached past the others.
        """
        agent, here = self.agent, (pose.x, pose.y)
        surroundings = ALONE
        if self._blocked > self.traffic.right.parameters.patience:
            agent.next_goal()
            surroundings = Surroundings(avoid=self.traffic.closed())
        decision = agent.decide(time, pose, flow, surroundings)
        self._blocked = 0.0
        if decision.wanted == STILL and not decision.aside:
            self.traffic.rest(here, lived)
            return decision
        goal = decision.path[-1] if decision.path else None
        passage = self.traffic.towards(goal, here, lived)
        if (
            goal is not None
            and decision.goal is agent.goal
            and agent.parameters.goals.strategy != 'fixed'
        ):
            self._blocked = passage.blocked
        return _heading(decision, passage, pose)


def _heading(decision: Decision, passage: Passage, pose: Pose) -> Decision:
    """Return ``decision`` with the heading, the path and the reason of ``passage``."""
    if passage.target is None and not decision.path:
        return decision
    omega, here = decision.wanted.omega, (pose.x, pose.y)
    activity = f'{decision.activity}: {passage.reason}' if passage.reason else decision.activity
    wanted = PolarCommand(0.0, 0.0, omega)
    if passage.target is not None:
        speed = decision.wanted.v if decision.path else 0.0
        speed = max(speed, decision.aside) if passage.gives_way else speed
        wanted = polar_command(pose, passage.target, speed, omega)
    return decision._replace(wanted=wanted, activity=activity, path=(here, *passage.path))
