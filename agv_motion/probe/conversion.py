"""From dT and dT_max to K and flux density, with what is known of wood, species and needles.

Heartwood: a needle that reaches through the sapwood sees no flow in its inner part. With the share
``g`` of it in sapwood, ``dT_sw = (dT - (1 - g) dT_max) / g`` is what the sapwood alone would show.
Source: M. J. Clearwater et al., "Potential errors in measurement of nonuniform sap flow using heat
dissipation probes", Tree Physiology 19, 1999.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from agv_motion.probe.damping import Damping
from agv_motion.probe.granier import flow_index

if TYPE_CHECKING:
    from agv_motion.probe.calibration import FluxCalibration
    from agv_motion.probe.damping import DampingParameters


def sapwood_difference(temperature_difference: float, zero_flow: float, share: float) -> float:
    """Return the temperature difference [K] that needles in sapwood alone would show.

    Args:
        temperature_difference: dT as read [K].
        zero_flow: dT_max [K].
        share: Of the needle that is in sapwood, in (0, 1].

    """
    return (temperature_difference - (1.0 - share) * zero_flow) / share


class Conversion:
    """Equations of one probe."""

    def __init__(
        self, calibration: FluxCalibration, needle_in_sapwood: float, damping: DampingParameters
    ) -> None:
        """Take what is known of the probe.

        Args:
            calibration: From K to flux density.
            needle_in_sapwood: Share of the needle that is in sapwood.
            damping: How K falls with the age of the needles.

        """
        self.calibration = calibration
        self._share = needle_in_sapwood
        self._damping = Damping(damping)

    def index(self, time: float, temperature_difference: float, zero_flow: float) -> float:
        """Return K, corrected; infinite where heartwood leaves no difference to the sapwood.

        Args:
            time: Of the reading [s since 1970].
            temperature_difference: dT, positive [K].
            zero_flow: dT_max [K].

        """
        difference = sapwood_difference(temperature_difference, zero_flow, self._share)
        if difference <= 0.0:
            return inf
        return flow_index(difference, zero_flow) * self._damping.gain(time)
