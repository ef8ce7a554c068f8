"""Figures and analyses of runs, read back from their bags; matplotlib lives here only.

`pose_columns` and `joint_columns` read topics by the stamps of their headers; `read_run` reads a
robot beside its Ghost, and `errors_between` tells how far apart they were. Each figure is a module
with one `draw`: `README.md` lists them.
"""

from agv_motion.report.run import read_run
from agv_motion.report.run_errors import errors_between
from agv_motion.report.stamped_columns import joint_columns, pose_columns

__all__ = [
    'errors_between',
    'joint_columns',
    'pose_columns',
    'read_run',
]
