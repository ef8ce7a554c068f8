"""Why a robot does what it does: a chain of reasons from its wheels back to its probes."""

from agv_motion.explanation.evidence import Evidence, Report
from agv_motion.explanation.explainer import Explainer
from agv_motion.explanation.link import Chain, Level, Link
from agv_motion.explanation.text import lines

__all__ = ['Chain', 'Evidence', 'Explainer', 'Level', 'Link', 'Report', 'lines']
