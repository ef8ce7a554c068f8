"""Tables as loggers and spreadsheets write them: any delimiter, decimal sign, encoding and time."""

from agv_motion.probe.tables.table import read_tables
from agv_motion.probe.tables.table_parameters import TableParameters

__all__ = ['TableParameters', 'read_tables']
