"""The nodes of a vehicle over recorded bags, without middleware.

`reprocess` runs a `Plan` over one bag; many at once: :mod:`agv_motion.reprocess.many_bags`.
"""

from agv_motion.reprocess.one_bag import Plan, reprocess

__all__ = [
    'Plan',
    'reprocess',
]
