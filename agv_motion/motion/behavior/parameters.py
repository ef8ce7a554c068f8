"""All that shapes the decisions of one tree."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from agv_motion.kinematics.platform import PLATFORM_RADIUS
from agv_motion.motion.behavior.goals.strategies import GoalParameters
from agv_motion.motion.behavior.homing import HomeParameters
from agv_motion.motion.behavior.memory import MemoryParameters
from agv_motion.motion.behavior.sap_flow import RestParameters
from agv_motion.motion.behavior.schedule import ScheduleParameters
from agv_motion.motion.command.polar import LINEAR_SPEED

if TYPE_CHECKING:
    from agv_motion.motion.navigation.polyline import Point


@dataclass(frozen=True)
class AgentParameters:
    """How an agent decides."""

    goals: GoalParameters = field(default_factory=GoalParameters)
    memory: MemoryParameters = field(default_factory=MemoryParameters)
    rest: RestParameters = field(default_factory=RestParameters)
    schedule: ScheduleParameters = field(default_factory=ScheduleParameters)
    home: HomeParameters = field(default_factory=HomeParameters)
    goal: Point | None = None
    """where to go, for a strategy that is told its goal [m]"""
    rest_until: float = 0.0
    """[s since 1970] rest until then, as somebody asked; 0: do not"""
    linear_speed: float = LINEAR_SPEED
    """[m/s] at v = 1"""
    platform_radius: float = PLATFORM_RADIUS
    """[m] how far the platform reaches: what must not turn over delicate floor"""
