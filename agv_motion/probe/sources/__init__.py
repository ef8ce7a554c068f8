"""Where the readings of the probes come from: simulated, recorded, or a serial line."""

from agv_motion.probe.sources.csv_file import CsvParameters, CsvSource
from agv_motion.probe.sources.serial_line import SerialParameters, SerialSource
from agv_motion.probe.sources.simulated import SimulatedSource, SimulatedSourceParameters
from agv_motion.probe.sources.source import ProbeSample, ProbeSource
from agv_motion.probe.sources.sources import SOURCES, SourceKind, SourceParameters

__all__ = [
    'SOURCES',
    'CsvParameters',
    'CsvSource',
    'ProbeSample',
    'ProbeSource',
    'SerialParameters',
    'SerialSource',
    'SimulatedSource',
    'SimulatedSourceParameters',
    'SourceKind',
    'SourceParameters',
]
