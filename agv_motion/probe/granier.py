"""From the temperature difference of a Granier probe to sap flux density.

Source: A. Granier, "Une nouvelle methode pour la mesure du flux de seve brute dans le tronc des
arbres", Annales des Sciences Forestieres 42(2), 1985.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

COEFFICIENT = 118.99e-6
"""[m/s] of Granier's calibration; equal to 42.84 cm/h."""

EXPONENT = 1.231


def flow_index(temperature_difference: float, zero_flow: float) -> float:
    """Return ``K = (dT_max - dT) / dT`` [-]; negative where the zero-flow value is out of date.

    Args:
        temperature_difference: dT between the needles, positive [K].
        zero_flow: dT_max, its value without flow, in the same unit.

    """
    return (zero_flow - temperature_difference) / temperature_difference


def flux_density(index: float) -> float:
    """Return the sap flux density ``F = 118.99e-6 K**1.231`` [m3 m-2 s-1]; 0 for negative K."""
    return COEFFICIENT * index**EXPONENT if index > 0.0 else 0.0


def flux_density_columns(
    temperature_difference: NDArray[np.float64], zero_flow: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return flux density [m/s] for columns of dT and dT_max; NaN where dT is not positive."""
    known = np.where(temperature_difference > 0.0, temperature_difference, np.nan)
    index = np.maximum((zero_flow - known) / known, 0.0)
    return np.asarray(COEFFICIENT * index**EXPONENT)
