"""Where the readings of the probes come from: simulated, recorded, a serial line, or MQTT.

`SourceParameters` name a source and open it; each keeps `ProbeSource` and gives a `ProbeSample` at
a time.
"""

from agv_motion.probe.sources.source import ProbeSample, ProbeSource
from agv_motion.probe.sources.sources import SourceParameters

__all__ = [
    'ProbeSample',
    'ProbeSource',
    'SourceParameters',
]
