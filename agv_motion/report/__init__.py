"""Figures and analyses of runs, read back from their bags; matplotlib lives here only."""

from agv_motion.report.calibration_drawing import Drawing, drawing_of
from agv_motion.report.calibration_drive import RecordedDrive, read_drive
from agv_motion.report.figure import figure
from agv_motion.report.run import RunBag, read_run
from agv_motion.report.run_errors import Errors, errors_between
from agv_motion.report.stamped_columns import JointColumns, PoseColumns, joint_columns, pose_columns

__all__ = [
    'Drawing',
    'Errors',
    'JointColumns',
    'PoseColumns',
    'RecordedDrive',
    'RunBag',
    'drawing_of',
    'errors_between',
    'figure',
    'joint_columns',
    'pose_columns',
    'read_drive',
    'read_run',
]
