"""The sap flow of a tree that follows the light where it stands, as its three probes tell it."""

from __future__ import annotations

from agv_motion.motion.behavior.sap_flow import SapFlow
from agv_motion.probe.granier import flow_index, flux_density
from agv_motion.probe.sources.simulated import SimulatedSource, SimulatedSourceParameters

PERIOD = 60.0
"""[s] between two readings: the stomata follow the light over a quarter of an hour."""


class SapSense:
    """Three simulated probes, each normalised by the flux density of a fair noon."""

    def __init__(self, seed: int) -> None:
        """Grow a tree whose weather and noise belong to ``seed``."""
        given = SimulatedSourceParameters(seed=seed, period=PERIOD, drift=0.0)
        self._source = SimulatedSource(given, 0.0)
        self._zero_flow = [given.zero_flow * (1.0 - 0.02 * probe) for probe in range(3)]
        self._fair = flux_density(given.fair_day_index)
        self._flow = SapFlow(0.0, 0.5, 0.0)

    def feel(self, time: float, light: float) -> SapFlow:
        """Return the normalised sap flow at ``time`` [s since 1970].

        Args:
            time: Now.
            light: At the place of the tree, as a share of that in the open.

        """
        self._source.set_light(light)
        for sample in self._source.read(time):
            flows = (
                flux_density(flow_index(value, zero)) / self._fair
                for value, zero in zip(sample.values, self._zero_flow, strict=True)
            )
            self._flow = SapFlow(*(min(max(flow, 0.0), 1.0) for flow in flows))
        return self._flow
