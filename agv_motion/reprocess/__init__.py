"""The nodes of a vehicle over recorded bags, without middleware."""

from agv_motion.reprocess.one_bag import Plan, ReprocessOutcome, reprocess

__all__ = [
    'Plan',
    'ReprocessOutcome',
    'reprocess',
]
