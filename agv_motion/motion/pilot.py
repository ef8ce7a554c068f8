"""The pilot of a tree: an agent decides, a navigator finds the path, one command comes of both."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from agv_motion.activity import Activity, Cause, Doing
from agv_motion.motion.command.polar import PolarCommand, polar_command
from agv_motion.motion.navigation.navigator import Guidance, StraightNavigator
from agv_motion.motion.navigation.path_follower import PathFollower

if TYPE_CHECKING:
    from agv_motion.motion.behavior.agent import Agent
    from agv_motion.motion.behavior.decision import Decision
    from agv_motion.motion.behavior.goals.goal import Goal
    from agv_motion.motion.behavior.sap_flow import SapFlow
    from agv_motion.motion.command.floor_rules import FloorRules
    from agv_motion.motion.navigation.navigator import Navigator
    from agv_motion.motion.navigation.polyline import Path
    from agv_motion.planar import Pose


class MotionCommand(NamedTuple):
    """How the tree is to move now, and why."""

    wanted: PolarCommand
    """before the limits"""
    doing: Doing
    """what it does, in words and for programs"""
    rules: FloorRules
    """what the floor allows, for the limits"""
    goal: Goal | None
    """what it seeks, or would if it moved"""
    path: Path
    """corners from here to where it goes; empty if it goes nowhere"""


class Pilot:
    """Brings one tree where its agent wants to be, as its navigator says."""

    def __init__(self, agent: Agent, navigator: Navigator) -> None:
        """Join the two."""
        self.agent, self.navigator = agent, navigator
        self._blocked: Goal | None = None
        """the goal to which others have barred the way for long"""

    def update(self, time: float, pose: Pose, flow: SapFlow, now: float) -> MotionCommand:
        """Return how to move now.

        Where the way to a goal of its own choice has been barred for long, the agent chooses
        another of those that can be reached past the others.

        Args:
            time: Of the day, in seconds since 1970.
            pose: Where the tree is, in the map.
            flow: Normalised sap flow, checked and believed.
            now: Time of the clock by which the navigator goes [s].

        """
        agent, navigator = self.agent, self.navigator
        closed = None
        if self._blocked is not None and agent.give_up(self._blocked):
            closed = navigator.closed()
        decision = agent.decide(time, pose, flow, closed)
        guidance = self._guide(decision, pose, now)
        self._blocked = decision.goal if guidance.blocked > navigator.patience else None
        if guidance.failure is not None and decision.goal is not None:
            agent.give_up(decision.goal)
        return motion_command(decision, guidance, pose)

    def _guide(self, decision: Decision, pose: Pose, now: float) -> Guidance:
        here = pose.x, pose.y
        if decision.destination is None and decision.yield_speed == 0.0:
            self.navigator.rest(here, now)
            return Guidance()
        return self.navigator.navigate(decision.destination, here, now, straight=decision.straight)


def pilot_alone(agent: Agent) -> Pilot:
    """Return the pilot of a tree that is alone: by paths in its zone, straight without one."""
    planner = agent.planner
    return Pilot(agent, StraightNavigator() if planner is None else PathFollower(planner))


def motion_command(decision: Decision, guidance: Guidance, pose: Pose) -> MotionCommand:
    """Return the command of a tree at ``pose`` that takes a decision and is guided there."""
    state, speed, rotation = decision.state, decision.speed, decision.rotation
    activity, because = decision.activity, decision.because
    if guidance.failure is not None:
        state, speed, rotation = f'stopped: {guidance.failure}', 0.0, 0.0
        activity, because = Activity.STOPPED, Cause.ZONE
    if guidance.reason:
        state, because = f'{state}: {guidance.reason}', Cause.OTHERS
        activity = Activity.WALKING if guidance.target is not None else Activity.WAITING
    if guidance.target is None:
        wanted = PolarCommand(0.0, 0.0, rotation)
    else:
        least = decision.yield_speed if guidance.gives_way else 0.0
        wanted = polar_command(pose, guidance.target, max(speed, least), rotation)
    doing = Doing(state, activity, because, guidance.waits_for)
    return MotionCommand(wanted, doing, decision.rules, decision.goal, guidance.path)
