"""Where the readings of the probes come from: simulated, recorded, a serial line, or MQTT.

Each keeps `ProbeSource` and gives a `ProbeSample` at a time; :mod:`.sources` names them all.
"""

from agv_motion.probe.sources.csv_file import CsvSource
from agv_motion.probe.sources.csv_parameters import CsvParameters
from agv_motion.probe.sources.serial_line import SerialParameters, SerialSource
from agv_motion.probe.sources.source import ProbeSample, ProbeSource

__all__ = [
    'CsvParameters',
    'CsvSource',
    'ProbeSample',
    'ProbeSource',
    'SerialParameters',
    'SerialSource',
]
