"""What to do now: goals, memory, hours, home and rest of one tree."""

from agv_motion.motion.behavior.agent import Agent
from agv_motion.motion.behavior.goals.strategies import GoalParameters
from agv_motion.motion.behavior.parameters import AgentParameters
from agv_motion.motion.behavior.sap_flow import SapFlow

__all__ = [
    'Agent',
    'AgentParameters',
    'GoalParameters',
    'SapFlow',
]
