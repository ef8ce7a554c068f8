"""The nodes of a vehicle over recorded bags, without middleware."""

from agv_motion.reprocess.one_bag import Plan, ReprocessOutcome, reprocess
from agv_motion.ros.many_bags import outcomes

__all__ = [
    'Plan',
    'ReprocessOutcome',
    'outcomes',
    'reprocess',
]
