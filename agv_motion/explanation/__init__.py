"""Why a robot does what it does: a chain of reasons from its wheels back to its probes."""

from agv_motion.explanation.evidence import Evidence
from agv_motion.explanation.explainer import Explainer
from agv_motion.explanation.text import lines

__all__ = [
    'Evidence',
    'Explainer',
    'lines',
]
