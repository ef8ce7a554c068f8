"""SENSE: Granier probes, from the raw voltage to a sap flow in [0, 1].

`Probe` reads one value at a time and remembers; `read_series` reads a whole series in one call;
`flow_index` and `flux_density` are Granier's equations alone. Where readings come from:
:mod:`agv_motion.probe.sources`.
"""

from agv_motion.probe.granier import flow_index, flux_density
from agv_motion.probe.parameters import ProbeParameters
from agv_motion.probe.probe import Probe, ProbeReading
from agv_motion.probe.series import read_series

__all__ = [
    'Probe',
    'ProbeParameters',
    'ProbeReading',
    'flow_index',
    'flux_density',
    'read_series',
]
